// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/mesh_solid.hpp"

#include "palpable/core/figure.hpp"
#include "palpable/sculpt/solid/mesh_distance.hpp"
#include "palpable/sculpt/solid/smooth_surface.hpp"
#include "palpable/sculpt/solid/surface_cut.hpp"
#include "palpable/sculpt/triangles/hole_closing.hpp"
#include "palpable/sculpt/triangles/mesh_orientation.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace palpable::sculpt {

std::vector<std::string> MeshRepair::notes() const {
  std::vector<std::string> notes;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count == 1) notes.emplace_back(one);
    if (count > 1) notes.push_back(std::to_string(count) + many);
  };
  add(not_finite, "One triangle with a vertex that is not a finite number was left out.",
      " triangles with a vertex that is not a finite number were left out.");
  add(degenerate, "One triangle without an area was left out.", " triangles without an area were left out.");
  add(turned_parts, "One part of the mesh was turned to face outwards.",
      " parts of the mesh were turned to face outwards.");
  add(closed_holes, "One hole in the mesh was closed.", " holes in the mesh were closed.");
  add(inner, "One triangle inside the solid was left out.", " triangles inside the solid were left out.");
  if (rounded > 0)
    notes.push_back(std::to_string(rounded) + " small facets were smoothed, by at most " +
                    std::to_string(std::lround(1e6 * rounded_m)) + " um.");
  add(ground, "One triangle of the ground around the solid was left out.",
      " triangles of the ground around the solid were left out.");
  const auto in_mm = [](double metres) { return figure(1e3 * metres, 2); };
  if (open_sheets > 0)
    notes.push_back((open_sheets == 1
                         ? "One open sheet, with air on both sides, was"
                         : std::to_string(open_sheets) + " open sheets, with air on both sides, were") +
                    " given a thickness of " + in_mm(wall_m) + " mm.");
  const std::size_t own_sheets = sheets - std::min(sheets, open_sheet_triangles);
  if (thin + own_sheets > 0)
    notes.push_back("Walls that are too thin for the field's cells (" + std::to_string(thin + own_sheets) +
                    " triangles, " + std::to_string(own_sheets) +
                    " of them of sheets without a thickness) were made " + in_mm(wall_m) +
                    " mm thick, so that they can be felt: at most " + in_mm(thickened_m) +
                    " mm were added to a side. More cells keep them thinner.");
  return notes;
}

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

/// Null if there are few facets to smooth.
std::unique_ptr<DistanceSource> smoothed(const Mesh& whole, double finest_m, const FacetOptions& facets,
                                         MeshRepair& repair) {
  auto smooth = std::make_unique<SmoothSurface>(
      whole, SmoothSurface::Rounding{facets.rounding_m, facets.most_cells_to_edge * finest_m,
                                     facets.coarse_share, facets.noise_turn_share, facets.noise_rise_share});
  const std::size_t count = smooth->rounded_facets();
  if (static_cast<double>(count) < facets.least_share * static_cast<double>(whole.triangles.size()))
    return nullptr;
  repair.rounded = count;
  repair.rounded_m = facets.rounding_m;
  return smooth;
}

/// A mesh without its open sheets; these, with the same vertices; and for each of their triangles its sheet.
struct SeparatedSheets {
  Mesh sheets;
  std::vector<std::uint32_t> numbers;
  std::size_t count = 0;
};

/// Orients the parts of a mesh and removes its open sheets. `holes` are those of the rest.
SeparatedSheets separate_sheets(Mesh& whole, std::vector<Hole>& holes, MeshRepair& repair, double touching_m,
                                const OpenSheetOptions& options, std::uint64_t seed) {
  const auto given = whole.triangles;
  repair.turned_parts = orient_outwards(whole, seed);
  holes = holes_of(whole.vertices_m, whole.triangles);
  const OpenSheets found = open_sheets_of(whole, holes, touching_m, options);
  SeparatedSheets separated;
  if (found.count == 0) return separated;
  separated.count = found.count;
  separated.sheets.vertices_m = whole.vertices_m;
  whole.triangles.clear();
  for (std::size_t t = 0; t < given.size(); ++t) {
    const bool is_sheet = found.of_triangle[t] != OpenSheets::kNone;
    (is_sheet ? separated.sheets.triangles : whole.triangles).push_back(given[t]);
    if (is_sheet) separated.numbers.push_back(found.of_triangle[t]);
  }
  // Rays from a body may have met the sheets around it.
  repair.turned_parts = orient_outwards(whole, seed);
  holes = holes_of(whole.vertices_m, whole.triangles);
  return separated;
}

/// Thickens walls and sheets. `sheet_candidates`: how many of the first triangles of `whole` are sheets where
/// they are outside the solid.
void thicken(MeshSolid& solid, const Mesh& surface, const Mesh& whole, std::size_t sheet_candidates,
             const SeparatedSheets& open, double finest_m, const WallOptions& options, const Work& work) {
  Mesh mesh;
  if (sheet_candidates + open.count > 0) mesh.vertices_m = whole.vertices_m;
  mesh.triangles.assign(whole.triangles.begin(),
                        whole.triangles.begin() + static_cast<std::ptrdiff_t>(sheet_candidates));
  mesh.triangles.insert(mesh.triangles.end(), open.sheets.triangles.begin(), open.sheets.triangles.end());
  SheetCandidates candidates{mesh, std::vector<std::uint32_t>(sheet_candidates, OpenSheets::kNone)};
  candidates.open_sheet.insert(candidates.open_sheet.end(), open.numbers.begin(), open.numbers.end());
  auto walls = thickened_walls(solid.distance, surface, candidates, finest_m, options, work);
  const std::size_t own_sheets = walls.sheets - walls.open_sheet_triangles;
  solid.repair.ground = walls.ground;
  solid.repair.inner -= std::min(solid.repair.inner, walls.ground);
  if (!walls.distance) return;
  solid.distance = std::move(walls.distance);
  solid.repair.thin = walls.thin;
  solid.repair.sheets = walls.sheets;
  solid.repair.open_sheets = walls.open_sheets;
  solid.repair.open_sheet_triangles = walls.open_sheet_triangles;
  solid.repair.inner -= std::min(solid.repair.inner, own_sheets);
  solid.repair.wall_m = options.least_cells * finest_m;
  solid.repair.thickened_m = walls.added_m;
}

}  // namespace

Result<MeshSolid> solid_from_mesh(const Mesh& mesh, double finest_m, const Work& work,
                                  const FacetOptions& facets, const WallOptions& walls,
                                  const OpenSheetOptions& sheets) {
  work.report(0.0, "repairing the mesh");
  MeshSolid solid;
  Mesh whole = welded(mesh, solid.repair.degenerate);
  if (whole.triangles.empty()) return invalid_input("holds no triangle that has an area");
  solid.repair.not_finite = without_place(mesh);
  solid.repair.degenerate -= solid.repair.not_finite;
  solid.repair.triangles = whole.triangles.size();
  std::vector<Hole> holes;
  const SeparatedSheets open = separate_sheets(whole, holes, solid.repair, finest_m, sheets, work.seed);
  if (work.cancelled()) return Work::interrupted();
  if (whole.triangles.empty()) {
    thicken(solid, whole, whole, 0, open, finest_m, walls, work);
    if (!solid.distance) return invalid_input("is a mesh that encloses no volume");
    return solid;
  }
  const std::size_t first_added = whole.triangles.size();
  solid.repair.closed_holes = add_lids(whole, holes);
  // Freed before the distance source builds its own tree: for millions of triangles it takes gigabytes.
  std::optional<TriangleTree> tree(whole);
  // The orientation by rays may be wrong for parts that were still open.
  if (solid.repair.closed_holes > 0) {
    const std::size_t turned = turn_inside_out_parts(whole, *tree);
    if (turned > 0) {
      // A part that shares walls with others leaves their common rims open when it is turned.
      solid.repair.closed_holes += close_holes(whole);
      tree.emplace(whole);
    }
    solid.repair.turned_parts += turned;
  }
  work.report(0.02, "finding the solid's surface");
  if (work.cancelled()) return Work::interrupted();
  if (is_watertight(whole) && is_own_surface(whole, *tree, first_added, work)) {
    tree.reset();
    if (facets.rounding_m > 0.0) solid.distance = smoothed(whole, finest_m, facets, solid.repair);
    if (!solid.distance) solid.distance = mesh_distance(whole, whole);
    thicken(solid, whole, whole, 0, open, finest_m, walls, work);
    return solid;
  }
  const SolidSurface surface = surface_of(whole, *tree, finest_m, work);
  tree.reset();
  if (work.cancelled()) return Work::interrupted();
  solid.repair.inner = surface.inner;
  if (!surface.mesh.triangles.empty())
    solid.distance = mesh_distance(surface.mesh, whole);
  else if (open.count == 0)
    return invalid_input("is a mesh that encloses no volume");
  // Triangles that close holes are not sheets.
  thicken(solid, surface.mesh, whole, first_added, open, finest_m, walls, work);
  if (!solid.distance) return invalid_input("is a mesh that encloses no volume");
  return solid;
}

std::optional<Error> mesh_too_large(std::size_t triangles, std::size_t free_bytes) {
  // Measured: welding, search trees and normals need at most 528 (docs/history/measurements-2026-11-21.md).
  constexpr std::size_t kBytesPerTriangle = 540;
  if (triangles <= free_bytes / kBytesPerTriangle) return std::nullopt;
  const auto mebi = [](std::size_t bytes) { return std::to_string(bytes >> 20U); };
  return Error{ErrorCode::failed,
               "has " + std::to_string(triangles) + " triangles, which would take about " +
                   mebi(triangles * kBytesPerTriangle) + " MiB, more than the " + mebi(free_bytes) +
                   " MiB that are free; " + std::to_string(free_bytes / kBytesPerTriangle / 1000 * 1000) +
                   " triangles would fit",
               {}};
}

Result<std::unique_ptr<DistanceSource>> solid_from_contour(const Mesh& mesh) {
  std::size_t degenerate = 0;
  const Mesh whole = welded(mesh, degenerate);
  if (whole.triangles.empty()) return invalid_input("holds no triangle that has an area");
  return mesh_distance(whole, whole);
}

}  // namespace palpable::sculpt
