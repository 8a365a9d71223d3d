// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/open_sheets.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/sculpt/triangles/mesh_edges.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace palpable::sculpt {
namespace {

using IndexTriple = std::array<std::uint32_t, 3>;

/// Twice a triangle's area, along its normal.
Vec3 doubled_area(std::span<const Vec3> vertices_m, const IndexTriple& t) {
  const Vec3 a = vertices_m[t[0]];
  return cross(vertices_m[t[1]] - a, vertices_m[t[2]] - a);
}

/// The part of a mesh that is still to be judged.
class Candidates {
 public:
  /// `chosen`: indices of the mesh's triangles.
  Candidates(const Mesh& mesh, std::vector<std::uint32_t> chosen) : mesh_(mesh), chosen_(std::move(chosen)) {
    triangles_.reserve(chosen_.size());
    for (const std::uint32_t t : chosen_) triangles_.push_back(mesh.triangles[t]);
  }
  std::vector<Hole> holes() const { return holes_of(mesh_.vertices_m, triangles_); }

  /// Marks the triangles of sheets. Returns the rest of the surfaces that they were part of.
  std::vector<std::uint32_t> remove_sheets(std::span<const Hole> holes, const OpenSheetOptions& options,
                                           std::vector<char>& is_sheet) {
    connect();
    std::map<std::uint32_t, std::vector<const Hole*>> of_surface;
    for (const Hole& hole : holes) of_surface[surface_[hole.rim.front().triangle]].push_back(&hole);
    std::vector<char> is_removed(triangles_.size()), is_changed(triangles_.size());
    for (const auto& [surface, own] : of_surface)
      for (const Hole* hole : outlines_among(surface, own, options))
        for (const Hole::RimEdge& edge : hole->rim) {
          if (closed_[part_[edge.triangle]] != 0) continue;
          is_removed[part_[edge.triangle]] = 1;
          is_changed[surface] = 1;
        }
    std::vector<std::uint32_t> rest;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (is_removed[part_[t]] != 0)
        is_sheet[chosen_[t]] = 1;
      else if (is_changed[surface_[t]] != 0 && closed_[part_[t]] == 0)
        rest.push_back(chosen_[t]);
    }
    return rest;
  }

 private:
  /// A lid as seen along its mean normal.
  struct Lid {
    const Hole* hole = nullptr;
    double area_m2 = 0.0;
    Vec3 normal;
    /// Height of the rim as a share of that of the surface.
    double height = 0.0;
    /// Mean cosine between the normals of lid and surface along the rim.
    double facing = 0.0;
  };

  /// Surfaces consist of parts, which meet at edges of more than two triangles.
  void connect() {
    const std::vector<EdgeUse> uses = edge_uses(triangles_);
    surface_ = connected_by_edges(triangles_.size(), uses);
    DisjointSets parts(triangles_.size());
    visit_edges(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 2) parts.join(edge[0].triangle, edge[1].triangle);
    });
    part_ = parts.firsts();
    // A part is closed if it uses each of its edges as often in one direction as in the other.
    closed_.assign(triangles_.size(), 1);
    std::vector<std::pair<std::uint32_t, int>> of_parts;
    visit_edges(uses, [&](std::span<const EdgeUse> edge) {
      of_parts.clear();
      for (const EdgeUse& use : edge) of_parts.emplace_back(part_[use.triangle], use.step);
      std::sort(of_parts.begin(), of_parts.end());
      for (std::size_t i = 0, end = 0; i < of_parts.size(); i = end) {
        int sum = 0;
        for (; end < of_parts.size() && of_parts[end].first == of_parts[i].first; ++end)
          sum += of_parts[end].second;
        if (sum != 0) closed_[of_parts[i].first] = 0;
      }
    });
  }

  /// The holes of a surface that are the outlines of sheets.
  std::vector<const Hole*> outlines_among(std::uint32_t surface, std::span<const Hole* const> holes,
                                          const OpenSheetOptions& options) const {
    double area_m2 = 0.0;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (surface_[t] == surface && closed_[part_[t]] == 0)
        area_m2 += 0.5 * norm(doubled_area(mesh_.vertices_m, triangles_[t]));
    std::vector<Lid> lids;
    double all_m2 = 0.0;
    for (const Hole* hole : holes) {
      lids.push_back(lid_of(*hole));
      all_m2 += lids.back().area_m2;
    }
    if (all_m2 <= std::min(options.most_tall_lids, options.most_sharp_lids) * area_m2) return {};
    // Many small holes would take long, and cannot be outlines.
    std::erase_if(lids, [&](const Lid& lid) { return lid.area_m2 < options.least_lid * area_m2; });
    double tall_m2 = 0.0, sharp_m2 = 0.0;
    const double sharp = -std::cos(options.sharp_angle_deg * std::numbers::pi / 180.0);
    for (Lid& lid : lids) {
      lid.height = height_share(lid, surface);
      tall_m2 += lid.area_m2 * lid.height;
      if (lid.facing < sharp) sharp_m2 += lid.area_m2;
    }
    const bool is_all = all_m2 > options.most_lids * area_m2,
               is_sharp = sharp_m2 > options.most_sharp_lids * area_m2,
               is_tall = tall_m2 > options.most_tall_lids * area_m2;
    std::vector<const Hole*> outlines;
    for (const Lid& lid : lids)
      if (is_all || (is_sharp && lid.facing < sharp) ||
          (is_tall && lid.height > options.least_outline_height))
        outlines.push_back(lid.hole);
    return outlines;
  }

  Lid lid_of(const Hole& hole) const {
    Lid lid;
    lid.hole = &hole;
    Vec3 sum;
    for (const IndexTriple& t : hole.lid) {
      const Vec3 doubled = doubled_area(mesh_.vertices_m, t);
      sum += 0.5 * doubled;
      lid.area_m2 += 0.5 * norm(doubled);
    }
    constexpr double kTwisted = 1e-6;
    if (norm(sum) > kTwisted * lid.area_m2) lid.normal = unit(sum);
    double length_m = 0.0;
    for (const Hole::RimEdge& edge : hole.rim) {
      const double here_m = norm(mesh_.vertices_m[edge.to] - mesh_.vertices_m[edge.from]);
      lid.facing += here_m * dot(lid.normal, unit(doubled_area(mesh_.vertices_m, triangles_[edge.triangle])));
      length_m += here_m;
    }
    if (length_m > 0.0) lid.facing /= length_m;
    return lid;
  }

  double height_share(const Lid& lid, std::uint32_t surface) const {
    if (squared_norm(lid.normal) == 0.0) return 1.0;
    struct Range {
      double least = std::numeric_limits<double>::infinity(), most = -least;
      void add(double v) { least = std::min(least, v), most = std::max(most, v); }
    };
    Range rim, all;
    for (const Hole::RimEdge& edge : lid.hole->rim) rim.add(dot(lid.normal, mesh_.vertices_m[edge.from]));
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (surface_[t] == surface && closed_[part_[t]] == 0)
        for (const std::uint32_t v : triangles_[t]) all.add(dot(lid.normal, mesh_.vertices_m[v]));
    return all.most > all.least ? (rim.most - rim.least) / (all.most - all.least) : 0.0;
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> chosen_;
  std::vector<IndexTriple> triangles_;
  /// For each triangle the first one of its surface and of its part; and for a part's first triangle whether
  /// the part is closed.
  std::vector<std::uint32_t> surface_, part_;
  std::vector<char> closed_;
};

/// Which triangles are of sheets, as numbers: the first triangle of each sheet, or kNone.
std::vector<std::uint32_t> numbered(const Mesh& mesh, const std::vector<char>& is_sheet) {
  std::vector<std::uint32_t> chosen;
  std::vector<IndexTriple> triangles;
  for (std::uint32_t t = 0; t < is_sheet.size(); ++t)
    if (is_sheet[t] != 0) chosen.push_back(t), triangles.push_back(mesh.triangles[t]);
  const auto first = connected_by_edges(triangles.size(), edge_uses(triangles));
  std::vector<std::uint32_t> sheet(is_sheet.size(), OpenSheets::kNone);
  for (std::size_t i = 0; i < chosen.size(); ++i) sheet[chosen[i]] = chosen[first[i]];
  return sheet;
}

/// The length of each sheet's rim, and of its part that lies neither on nor in `bodies`, nor on the sheet
/// itself.
struct RimLength {
  double all_m = 0.0, free_m = 0.0;
};
std::map<std::uint32_t, RimLength> rim_lengths(const Mesh& mesh, const std::vector<std::uint32_t>& sheet,
                                               const TriangleTree& bodies, double touching_m) {
  std::vector<std::uint32_t> chosen;
  Mesh sheets;
  sheets.vertices_m = mesh.vertices_m;
  for (std::uint32_t t = 0; t < sheet.size(); ++t)
    if (sheet[t] != OpenSheets::kNone) chosen.push_back(t), sheets.triangles.push_back(mesh.triangles[t]);
  const TriangleTree tree(sheets);
  // Files use single precision: a sheet that ends on itself may be apart from itself by the last digit.
  constexpr double kSameShare = 2e-7;
  const double same_m = kSameShare * norm(tree.bounds().size_m());
  const auto is_on_itself = [&](Vec3 place, std::uint32_t own) {
    bool is_on = false;
    const Vec3 by{same_m, same_m, same_m};
    tree.visit_box(place - by, place + by, [&](std::uint32_t other) {
      if (other == own || sheet[chosen[other]] != sheet[chosen[own]]) return;
      const IndexTriple& t = sheets.triangles[other];
      is_on = is_on ||
              nearest_on_triangle(place, mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]])
                      .squared_distance_m2 <= same_m * same_m;
    });
    return is_on;
  };
  std::map<std::uint32_t, RimLength> lengths;
  visit_edges(edge_uses(sheets.triangles), [&](std::span<const EdgeUse> edge) {
    // Where three triangles meet, such as walls and a floor inside, nothing is open.
    if (edge.size() > 1) return;
    const std::uint32_t own = edge.front().triangle;
    const Vec3 from = mesh.vertices_m[edge.front().key >> 32U],
               way = mesh.vertices_m[static_cast<std::uint32_t>(edge.front().key)] - from;
    RimLength& length = lengths[sheet[chosen[own]]];
    length.all_m += norm(way);
    constexpr std::array kShares{0.1, 0.5, 0.9};
    for (const double share : kShares) {
      const Vec3 place = from + share * way;
      const bool is_hidden = bodies.any_within(place, touching_m, OpenSheets::kNone) ||
                             std::abs(bodies.winding(place)) > 0.5 || is_on_itself(place, own);
      if (!is_hidden) length.free_m += norm(way) / kShares.size();
    }
  });
  return lengths;
}

/// Returns sheets whose rims are hidden to the bodies, until no more are found.
void return_hidden(const Mesh& mesh, double touching_m, const OpenSheetOptions& options,
                   std::vector<char>& is_sheet) {
  for (bool any = true; any;) {
    any = false;
    Mesh bodies;
    for (std::size_t t = 0; t < is_sheet.size(); ++t)
      if (is_sheet[t] == 0) bodies.triangles.push_back(mesh.triangles[t]);
    if (bodies.triangles.empty() || bodies.triangles.size() == is_sheet.size()) return;
    bodies.vertices_m = mesh.vertices_m;
    close_holes(bodies);
    const std::vector<std::uint32_t> sheet = numbered(mesh, is_sheet);
    const auto lengths = rim_lengths(mesh, sheet, TriangleTree(bodies), touching_m);
    for (std::size_t t = 0; t < is_sheet.size(); ++t) {
      if (sheet[t] == OpenSheets::kNone) continue;
      const auto length = lengths.find(sheet[t]);
      if (length == lengths.end() || length->second.free_m > options.most_free_rim * length->second.all_m)
        continue;
      is_sheet[t] = 0;
      any = true;
    }
  }
}

}  // namespace

std::vector<Parameter> parameters_of(OpenSheetOptions& o) {
  return {
      {"most_tall_lids", &o.most_tall_lids, {0.0, 10.0}, "", "greatest share of tall lids in a body's area"},
      {"most_sharp_lids",
       &o.most_sharp_lids,
       {0.0, 10.0},
       "",
       "greatest share of lids at sharp angles in a body's area"},
      {"sharp_angle_deg",
       &o.sharp_angle_deg,
       {0.0, 180.0},
       "degrees",
       "angle between lid and surface below which it is sharp"},
      {"most_lids", &o.most_lids, {0.0, 10.0}, "", "greatest share of all lids in a body's area"},
      {"most_two_sided_lids",
       &o.most_two_sided_lids,
       {0.0, 10.0},
       "",
       "greatest share of lids in the area of a body of two-sided triangles"},
      {"least_lid", &o.least_lid, {0.0, 1.0}, "", "share of the area below which a lid is no outline"},
      {"least_outline_height",
       &o.least_outline_height,
       {0.0, 1.0},
       "",
       "share of the height through which an outline reaches"},
      {"most_free_rim", &o.most_free_rim, {0.0, 1.0}, "", "greatest free share of a rim that bodies hide"}};
}

OpenSheets open_sheets_of(const Mesh& mesh, std::span<const Hole> holes, double touching_m,
                          const OpenSheetOptions& options) {
  PALPABLE_CHECK(check_ranges(options));
  OpenSheets sheets;
  if (holes.empty()) return sheets;
  const std::size_t count = mesh.triangles.size();
  std::vector<char> is_sheet(count);
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  std::vector<std::uint32_t> rest = Candidates(mesh, std::move(all)).remove_sheets(holes, options, is_sheet);
  // Each round removes at least one part.
  while (!rest.empty()) {
    Candidates candidates(mesh, std::move(rest));
    rest = candidates.remove_sheets(candidates.holes(), options, is_sheet);
  }
  return_hidden(mesh, touching_m, options, is_sheet);
  sheets.of_triangle = numbered(mesh, is_sheet);
  for (std::uint32_t t = 0; t < count; ++t) {
    std::uint32_t& sheet = sheets.of_triangle[t];
    if (sheet == OpenSheets::kNone) continue;
    // The first triangle of a sheet comes before its others.
    sheet = sheet == t ? static_cast<std::uint32_t>(sheets.count++) : sheets.of_triangle[sheet];
  }
  if (sheets.count == 0) sheets.of_triangle.clear();
  return sheets;
}

}  // namespace palpable::sculpt
