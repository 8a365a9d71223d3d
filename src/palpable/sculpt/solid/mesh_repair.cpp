// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/mesh_repair.hpp"

#include "palpable/sculpt/triangles/coincident_triangles.hpp"
#include "palpable/sculpt/triangles/enclosed_cells.hpp"
#include "palpable/sculpt/triangles/joined_bodies.hpp"
#include "palpable/sculpt/triangles/joined_sheets.hpp"
#include "palpable/sculpt/triangles/mesh_edges.hpp"
#include "palpable/sculpt/triangles/mesh_orientation.hpp"
#include "palpable/sculpt/triangles/near_rims.hpp"
#include "palpable/sculpt/triangles/touching_edges.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace palpable::sculpt {
namespace {

/// Number of triangles with a vertex that is missing or not finite.
std::size_t without_place(const Mesh& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
        return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
          return v >= mesh.vertices_m.size() || !is_finite(mesh.vertices_m[v]);
        });
      }));
}

/// How a welded mesh is divided before it is judged.
struct Division {
  /// Closed bodies that face outwards, first; then triangles whose orientation may be wrong.
  Mesh mesh;
  std::size_t oriented = 0;
  /// Open two-sided surfaces with the vertices of `mesh`, and for each triangle its number.
  std::vector<std::array<std::uint32_t, 3>> sheets;
  std::vector<std::uint32_t> sheet_of;
  std::size_t sheet_count = 0;
};

/// For each triangle, whether its surface contains two-sided triangles, or has edges of more than two
/// triangles and is not consistently oriented.
std::vector<char> to_be_examined(const Mesh& mesh, std::span<const char> is_two_sided) {
  const std::size_t count = mesh.triangles.size();
  const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
  std::vector<char> is_branched(count), is_open(count), is_examined(count);
  bool any = !is_two_sided.empty();
  visit_edges(uses, [&](std::span<const EdgeUse> edge) {
    int sum = 0;
    for (const EdgeUse& use : edge) sum += use.step;
    if (edge.size() > 2) is_branched[edge.front().triangle] = 1, any = true;
    if (sum != 0) is_open[edge.front().triangle] = 1;
  });
  if (!any) return {};
  const std::vector<std::uint32_t> surface = connected_by_edges(count, uses);
  struct Kind {
    bool two_sided = false, branched = false, open = false;
  };
  std::vector<Kind> kinds(count);
  for (std::size_t t = 0; t < count; ++t) {
    Kind& kind = kinds[surface[t]];
    kind.two_sided = kind.two_sided || (!is_two_sided.empty() && is_two_sided[t] != 0);
    kind.branched = kind.branched || is_branched[t] != 0;
    kind.open = kind.open || is_open[t] != 0;
  }
  any = false;
  for (std::size_t t = 0; t < count; ++t) {
    const Kind& kind = kinds[surface[t]];
    is_examined[t] = kind.two_sided || (kind.branched && kind.open) ? 1 : 0;
    any = any || is_examined[t] != 0;
  }
  if (!any) is_examined.clear();
  return is_examined;
}

/// For each triangle, whether its surface has a rim: an edge of an odd number of triangles.
std::vector<char> of_surfaces_with_rims(const Mesh& mesh) {
  const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
  const std::vector<std::uint32_t> surface = connected_by_edges(mesh.triangles.size(), uses);
  std::vector<char> has_rim(mesh.triangles.size());
  visit_edges(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() % 2 == 1) has_rim[surface[edge.front().triangle]] = 1;
  });
  for (std::size_t t = 0; t < has_rim.size(); ++t) has_rim[t] = has_rim[surface[t]];
  return has_rim;
}

/// Some triangles of a mesh, with its vertices.
Mesh part_of(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  Mesh part;
  part.vertices_m = mesh.vertices_m;
  for (const std::uint32_t t : triangles) part.triangles.push_back(mesh.triangles[t]);
  return part;
}

/// Whether an open two-sided surface is a body with small holes.
bool is_body_with_holes(Mesh surface, const OpenSheetOptions& options, std::uint64_t seed) {
  orient_outwards(surface, seed);
  const auto area = [&](const std::array<std::uint32_t, 3>& t) {
    const Vec3 a = surface.vertices_m[t[0]];
    return 0.5 * norm(cross(surface.vertices_m[t[1]] - a, surface.vertices_m[t[2]] - a));
  };
  double lids_m2 = 0.0, all_m2 = 0.0;
  for (const Hole& hole : holes_of(surface.vertices_m, surface.triangles))
    for (const auto& t : hole.lid) lids_m2 += area(t);
  for (const auto& t : surface.triangles) all_m2 += area(t);
  return lids_m2 <= options.most_two_sided_lids * all_m2;
}

/// Divides a welded mesh without coincident triangles.
class Divider {
 public:
  Divider(Mesh mesh, std::vector<char> is_two_sided, MeshRepair& repair)
      : mesh_(std::move(mesh)), is_two_sided_(std::move(is_two_sided)), repair_(repair) {}

  Division divided(double touching_m, const OpenSheetOptions& options, std::uint64_t seed) {
    Division division;
    if (!find_cells_of_divided_edges(touching_m)) {
      const std::vector<char> is_examined = to_be_examined(mesh_, is_two_sided_);
      if (is_examined.empty()) {
        division.mesh = std::move(mesh_);
        return division;
      }
      if (is_two_sided_.empty()) is_two_sided_.assign(mesh_.triangles.size(), 0);
      sides_ = find_enclosed_cells(mesh_, is_examined);
    }
    add_bodies(division);
    std::vector<std::uint32_t> open;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (sides_[t] == CellSide::open) open.push_back(t);
    std::vector<std::uint32_t> kept = without_two_sided_sheets(open, division, options, seed);
    for (const std::uint32_t t : kept) division.mesh.triangles.push_back(mesh_.triangles[t]);
    add_reverse_sides(kept, division.mesh);
    return division;
  }

 private:
  /// Divides edges that rims touch. If surfaces with rims enclose cells only afterwards, keeps the divided
  /// triangles at these cells, and the cells; else changes nothing and returns false.
  bool find_cells_of_divided_edges(double touching_m) {
    const std::optional<DividedMesh> divided = divide_touching_edges(mesh_, touching_m, TouchingEdges::all);
    if (!divided) return false;
    Mesh mesh = divided->mesh;
    const std::vector<std::uint32_t>& part_of = divided->part_of;
    std::vector<char> is_two_sided;
    if (!is_two_sided_.empty())
      for (const std::uint32_t t : part_of) is_two_sided.push_back(is_two_sided_[t]);
    const std::vector<char> is_examined = to_be_examined(mesh, is_two_sided);
    if (is_examined.empty()) return false;
    const std::vector<CellSide> sides = find_enclosed_cells(mesh, is_examined);
    const std::vector<char> before = to_be_examined(mesh_, is_two_sided_);
    Mesh undivided = mesh_;
    const std::vector<CellSide> sides_before =
        before.empty() ? std::vector<CellSide>(mesh_.triangles.size(), CellSide::open)
                       : find_enclosed_cells(undivided, before);
    // A closed surface that only touches others encloses no more than before.
    const std::vector<char> has_rim = of_surfaces_with_rims(mesh_);
    std::vector<char> is_at_cell(mesh_.triangles.size());
    bool is_more = false;
    for (std::size_t t = 0; t < part_of.size(); ++t) {
      if (sides[t] == CellSide::open) continue;
      is_at_cell[part_of[t]] = 1;
      is_more = is_more || (sides[t] == CellSide::boundary && sides_before[part_of[t]] == CellSide::open &&
                            has_rim[part_of[t]] != 0);
    }
    if (!is_more) return false;
    keep_divided(mesh, part_of, sides, is_at_cell);
    return true;
  }

  /// Replaces the triangles of which pieces are at cells by their pieces. The others stay whole and share no
  /// edges with surfaces that they only touch, so that their holes are those of the given mesh.
  void keep_divided(const Mesh& mesh, std::span<const std::uint32_t> part_of, std::span<const CellSide> sides,
                    std::span<const char> is_at_cell) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<char> is_two_sided;
    const auto add = [&](const std::array<std::uint32_t, 3>& triangle, std::uint32_t given, CellSide side) {
      triangles.push_back(triangle);
      is_two_sided.push_back(is_two_sided_.empty() ? 0 : is_two_sided_[given]);
      sides_.push_back(side);
    };
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (is_at_cell[t] == 0) add(mesh_.triangles[t], t, CellSide::open);
    for (std::size_t t = 0; t < part_of.size(); ++t)
      if (is_at_cell[part_of[t]] != 0) add(mesh.triangles[t], part_of[t], sides[t]);
    mesh_.triangles = std::move(triangles);
    is_two_sided_ = std::move(is_two_sided);
  }

  /// Bodies get vertices of their own, so that no edge connects them with sheets.
  void add_bodies(Division& division) {
    const std::size_t count = mesh_.triangles.size();
    division.mesh.vertices_m = mesh_.vertices_m;
    constexpr std::uint32_t kNew = 0xFFFFFFFFU;
    std::vector<std::uint32_t> own(mesh_.vertices_m.size(), kNew);
    for (std::size_t t = 0; t < count; ++t) {
      if (sides_[t] == CellSide::inner) ++repair_.inner;
      if (sides_[t] != CellSide::boundary) continue;
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& vertex = own[mesh_.triangles[t][k]];
        if (vertex == kNew) {
          vertex = static_cast<std::uint32_t>(division.mesh.vertices_m.size());
          division.mesh.vertices_m.push_back(mesh_.vertices_m[mesh_.triangles[t][k]]);
        }
        triangle[k] = vertex;
      }
      division.mesh.triangles.push_back(triangle);
    }
    division.oriented = division.mesh.triangles.size();
    count_two_sided_bodies();
  }

  /// Counts closed surfaces with two-sided triangles, and those that lie in others.
  void count_two_sided_bodies() {
    std::vector<std::uint32_t> boundary;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (sides_[t] == CellSide::boundary) boundary.push_back(t);
    const Mesh bodies = part_of(mesh_, boundary);
    const auto first = connected_by_edges(boundary.size(), edge_uses(bodies.triangles));
    // Of each surface its outermost vertex.
    std::map<std::uint32_t, Vec3> outermost;
    for (std::size_t i = 0; i < boundary.size(); ++i)
      if (is_two_sided_[boundary[i]] != 0)
        outermost.try_emplace(first[i], bodies.vertices_m[bodies.triangles[i][0]]);
    if (outermost.empty()) return;
    for (std::size_t i = 0; i < boundary.size(); ++i)
      if (const auto at = outermost.find(first[i]); at != outermost.end())
        for (const std::uint32_t v : bodies.triangles[i])
          if (bodies.vertices_m[v].x > at->second.x) at->second = bodies.vertices_m[v];
    repair_.two_sided_bodies = outermost.size();
    const TriangleTree tree(bodies);
    const double lift_m = 1e-6 * norm(bounds_of(mesh_).size_m());
    for (const auto& [surface, place] : outermost)
      if (tree.winding(place + Vec3{lift_m, 0.0, 0.0}) > 0.5) ++repair_.two_sided_inner_shells;
  }

  /// Removes the open surfaces that consist of two-sided triangles, unless they are bodies with holes.
  std::vector<std::uint32_t> without_two_sided_sheets(const std::vector<std::uint32_t>& open,
                                                      Division& division, const OpenSheetOptions& options,
                                                      std::uint64_t seed) {
    const Mesh part = part_of(mesh_, open);
    const auto first = connected_by_edges(open.size(), edge_uses(part.triangles));
    std::map<std::uint32_t, std::vector<std::uint32_t>> surfaces;
    for (std::size_t i = 0; i < open.size(); ++i) surfaces[first[i]].push_back(open[i]);
    std::vector<std::uint32_t> kept;
    for (const auto& [surface, triangles] : surfaces) {
      const bool two_sided = std::all_of(triangles.begin(), triangles.end(),
                                         [&](std::uint32_t t) { return is_two_sided_[t] != 0; });
      if (!two_sided || is_body_with_holes(part_of(mesh_, triangles), options, seed)) {
        if (two_sided) ++repair_.two_sided_bodies;
        kept.insert(kept.end(), triangles.begin(), triangles.end());
        continue;
      }
      for (const std::uint32_t t : triangles) {
        division.sheets.push_back(mesh_.triangles[t]);
        division.sheet_of.push_back(static_cast<std::uint32_t>(division.sheet_count));
      }
      ++division.sheet_count;
      ++repair_.two_sided_sheets;
    }
    std::sort(kept.begin(), kept.end());
    return kept;
  }

  /// Two-sided triangles that meet other triangles where these have no opening, such as a wall between two
  /// houses, need both of their sides; where the others are open, they continue them with one side.
  void add_reverse_sides(const std::vector<std::uint32_t>& kept, Mesh& mesh) {
    std::vector<std::uint32_t> two_sided;
    for (const std::uint32_t t : kept)
      if (is_two_sided_[t] != 0) two_sided.push_back(t);
    if (two_sided.empty() || two_sided.size() == kept.size()) return;
    const Mesh part = part_of(mesh_, two_sided), all = part_of(mesh_, kept);
    const auto first = connected_by_edges(two_sided.size(), edge_uses(part.triangles));
    std::map<std::uint32_t, std::uint32_t> patch_of;
    for (std::size_t i = 0; i < two_sided.size(); ++i) patch_of[two_sided[i]] = first[i];
    // Length of the edges where the others have an opening, minus that where they have none.
    std::map<std::uint32_t, double> opening_m;
    visit_edges(edge_uses(all.triangles), [&](std::span<const EdgeUse> edge) {
      std::size_t others = 0;
      for (const EdgeUse& use : edge) others += is_two_sided_[kept[use.triangle]] == 0 ? 1 : 0;
      if (others == 0 || others == edge.size()) return;
      const double length_m = norm(mesh_.vertices_m[edge.front().key >> 32U] -
                                   mesh_.vertices_m[static_cast<std::uint32_t>(edge.front().key)]);
      for (const EdgeUse& use : edge)
        if (const auto patch = patch_of.find(kept[use.triangle]); patch != patch_of.end())
          opening_m[patch->second] += others % 2 == 1 ? length_m : -length_m;
    });
    for (const std::uint32_t t : two_sided) {
      const auto opening = opening_m.find(patch_of.at(t));
      if (opening == opening_m.end() || opening->second > 0.0) continue;
      const auto& given = mesh_.triangles[t];
      mesh.triangles.push_back({given[0], given[2], given[1]});
      --repair_.two_sided;
    }
  }

  Mesh mesh_;
  std::vector<char> is_two_sided_;
  MeshRepair& repair_;
  std::vector<CellSide> sides_;
};

}  // namespace

RepairedMesh repaired(const Mesh& mesh, double touching_m, const OpenSheetOptions& options,
                      std::uint64_t seed, MeshRepair& repair) {
  RepairedMesh result;
  Mesh clean = welded(mesh, repair.degenerate);
  repair.not_finite = without_place(mesh);
  repair.degenerate -= repair.not_finite;
  if (clean.triangles.empty()) return result;
  // Files use single precision, and compute the corners of neighbouring faces one by one: places that
  // coincide may be apart by the last digits.
  constexpr double kNearShare = 1e-6;
  constexpr double kTouchingShare = 2e-7;
  const double size_m = norm(bounds_of(clean).size_m());
  repair.degenerate += join_near_rims(clean, kNearShare * size_m);
  repair.triangles = clean.triangles.size();
  if (clean.triangles.empty()) return result;
  CoincidentTriangles coincident = merge_coincident(clean);
  repair.repeated = coincident.repeated;
  repair.two_sided =
      static_cast<std::size_t>(std::count(coincident.is_two_sided.begin(), coincident.is_two_sided.end(), 1));
  const double same_m = kTouchingShare * size_m;
  Division division =
      Divider(std::move(clean), std::move(coincident.is_two_sided), repair).divided(same_m, options, seed);
  Mesh& whole = result.whole;
  whole = std::move(division.mesh);
  auto given = whole.triangles;
  OpenSheets found;
  if (!whole.triangles.empty()) {
    repair.turned_parts = orient_outwards(whole, seed, division.oriented);
    result.holes = holes_of(whole.vertices_m, whole.triangles);
    found = open_sheets_of(whole, result.holes, touching_m, options);
    if (found.count > 0) join_sheets(whole, given, found, {same_m, touching_m}, options, seed);
  }
  result.sheet_count = found.count + division.sheet_count;
  if (result.sheet_count > 0) {
    result.sheets.vertices_m = whole.vertices_m;
    result.sheets.triangles = std::move(division.sheets);
    result.sheet_of = std::move(division.sheet_of);
  }
  if (found.count > 0) {
    whole.triangles.clear();
    for (std::size_t t = 0; t < given.size(); ++t) {
      const bool is_sheet = found.of_triangle[t] != OpenSheets::kNone;
      (is_sheet ? result.sheets.triangles : whole.triangles).push_back(given[t]);
      if (is_sheet)
        result.sheet_of.push_back(found.of_triangle[t] + static_cast<std::uint32_t>(division.sheet_count));
    }
    // Rays from a body may have met the sheets around it.
    repair.turned_parts = orient_outwards(whole, seed, division.oriented);
    result.holes = holes_of(whole.vertices_m, whole.triangles);
  }
  if (join_bodies(whole, result.holes, {same_m, touching_m}, options, seed)) {
    orient_outwards(whole, seed, division.oriented);
    result.holes = holes_of(whole.vertices_m, whole.triangles);
  }
  return result;
}

}  // namespace palpable::sculpt
