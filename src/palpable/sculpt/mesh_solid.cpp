// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/mesh_solid.hpp"

#include "palpable/sculpt/mesh_distance.hpp"
#include "palpable/sculpt/mesh_orientation.hpp"
#include "palpable/sculpt/surface_cut.hpp"
#include "palpable/sculpt/triangle_tree.hpp"

#include <optional>

namespace palpable::sculpt {

std::vector<std::string> MeshRepair::notes() const {
  std::vector<std::string> notes;
  const auto tell = [&](std::size_t count, const char* one, const char* many) {
    if (count == 1) notes.emplace_back(one);
    if (count > 1) notes.push_back(std::to_string(count) + many);
  };
  tell(degenerate, "One triangle without an area was left out.", " triangles without an area were left out.");
  tell(turned_parts, "One part of the mesh was turned to face outwards.",
       " parts of the mesh were turned to face outwards.");
  tell(closed_holes, "One hole in the mesh was closed.", " holes in the mesh were closed.");
  tell(inner, "One triangle inside the solid was left out.", " triangles inside the solid were left out.");
  return notes;
}

Result<MeshSolid> solid_from_mesh(const Mesh& mesh, double finest_m, const Work& work) {
  work.report(0.0, "mending the mesh");
  MeshSolid solid;
  Mesh whole = welded(mesh, solid.repair.degenerate);
  if (whole.triangles.empty()) return invalid_input("holds no triangle that has an area");
  solid.repair.triangles = whole.triangles.size();
  solid.repair.turned_parts = orient_outwards(whole, work.seed);
  solid.repair.closed_holes = close_holes(whole);
  if (work.cancelled()) return Work::interrupted();
  // Given back before the distance makes its own: of millions of triangles it takes gigabytes.
  std::optional<TriangleTree> tree(whole);
  work.report(0.02, "finding the solid's surface");
  if (work.cancelled()) return Work::interrupted();
  if (is_watertight(whole) && is_own_surface(whole, *tree, work.seed)) {
    tree.reset();
    solid.distance = mesh_distance(whole, whole);
    return solid;
  }
  const SolidSurface surface = surface_of(whole, *tree, finest_m, work);
  tree.reset();
  if (work.cancelled()) return Work::interrupted();
  solid.repair.inner = surface.inner;
  if (surface.mesh.triangles.empty()) return invalid_input("is a mesh that encloses no volume");
  solid.distance = mesh_distance(surface.mesh, whole);
  return solid;
}

Result<std::unique_ptr<DistanceSource>> solid_from_contour(const Mesh& mesh) {
  std::size_t degenerate = 0;
  const Mesh whole = welded(mesh, degenerate);
  if (whole.triangles.empty()) return invalid_input("holds no triangle that has an area");
  return mesh_distance(whole, whole);
}

}  // namespace palpable::sculpt
