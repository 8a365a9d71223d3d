// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/mesh_solid.hpp"

#include "palpable/sculpt/solid/mesh_distance.hpp"
#include "palpable/sculpt/solid/small_facets.hpp"
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

namespace {

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

/// How closely a field has to follow each triangle of a surface that is not smoothed; empty if few of its
/// facets are those of a curved one.
std::vector<FacetTolerance> tolerances_of(const Mesh& surface, double finest_m, const FacetOptions& facets) {
  if (!(facets.rounding_m > 0.0)) return {};
  std::vector<FacetTolerance> all =
      facet_tolerances(surface, {facets.rounding_m, facets.most_cells_to_edge * finest_m});
  const auto count = std::count_if(all.begin(), all.end(), [](FacetTolerance t) { return t.turn > 0.0F; });
  if (static_cast<double>(count) < facets.least_share * static_cast<double>(all.size())) return {};
  for (FacetTolerance& t : all) {
    t.rise_m *= static_cast<float>(facets.cut_rise_share);
    t.turn *= static_cast<float>(facets.cut_turn_share);
  }
  return all;
}

/// Thickens walls and sheets. `sheet_candidates`: how many of the first triangles of `whole` are sheets where
/// they are outside the solid.
void thicken(MeshSolid& solid, const Mesh& surface, std::size_t sheet_candidates,
             const RepairedMesh& repaired, double finest_m, const WallOptions& options, const Work& work) {
  Mesh mesh;
  const Mesh& whole = repaired.whole;
  if (sheet_candidates + repaired.sheet_count > 0) mesh.vertices_m = whole.vertices_m;
  mesh.triangles.assign(whole.triangles.begin(),
                        whole.triangles.begin() + static_cast<std::ptrdiff_t>(sheet_candidates));
  mesh.triangles.insert(mesh.triangles.end(), repaired.sheets.triangles.begin(),
                        repaired.sheets.triangles.end());
  SheetCandidates candidates{mesh, std::vector<std::uint32_t>(sheet_candidates, OpenSheets::kNone)};
  candidates.open_sheet.insert(candidates.open_sheet.end(), repaired.sheet_of.begin(),
                               repaired.sheet_of.end());
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
  RepairedMesh repair = repaired(mesh, finest_m, sheets, work.seed, solid.repair);
  Mesh& whole = repair.whole;
  if (solid.repair.triangles == 0) return invalid_input("holds no triangle that has an area");
  if (work.cancelled()) return Work::interrupted();
  if (whole.triangles.empty()) {
    thicken(solid, whole, 0, repair, finest_m, walls, work);
    if (!solid.distance) return invalid_input("is a mesh that encloses no volume");
    return solid;
  }
  const std::size_t first_added = whole.triangles.size();
  add_lids(whole, repair.holes);
  solid.repair.add_closed(whole.vertices_m, repair.holes);
  // Freed before the distance source builds its own tree: for millions of triangles it takes gigabytes.
  std::optional<TriangleTree> tree(whole);
  // The orientation by rays may be wrong for parts that were still open.
  if (solid.repair.closed_holes > 0) {
    const std::size_t turned = turn_inside_out_parts(whole, *tree);
    if (turned > 0) {
      // A part that shares walls with others leaves their common rims open when it is turned.
      const std::vector<Hole> holes = holes_of(whole.vertices_m, whole.triangles);
      add_lids(whole, holes);
      solid.repair.add_closed(whole.vertices_m, holes);
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
    thicken(solid, whole, 0, repair, finest_m, walls, work);
    return solid;
  }
  const SolidSurface surface = surface_of(whole, *tree, finest_m, work);
  tree.reset();
  if (work.cancelled()) return Work::interrupted();
  solid.repair.inner = surface.inner;
  if (!surface.mesh.triangles.empty())
    solid.distance = mesh_distance(surface.mesh, whole, tolerances_of(surface.mesh, finest_m, facets));
  else if (repair.sheet_count == 0)
    return invalid_input("is a mesh that encloses no volume");
  // Triangles that close holes are not sheets.
  thicken(solid, surface.mesh, first_added, repair, finest_m, walls, work);
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
