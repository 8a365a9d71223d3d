// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make_field.hpp"

#include "palpable/sculpt/mesh_solid.hpp"
#include "palpable/sources/mesh_file.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

using SceneFromInput = Transform<SceneFrame, models::InputFrame>;

Error at_place(Error error, const std::filesystem::path& place) {
  if (error.place.empty()) error.place = place.string();
  return error;
}

/// Of the finite vertices that a triangle uses.
Result<sculpt::Box> box_of(const Mesh& mesh) {
  bool any = false;
  sculpt::Box box;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t index : t) {
      if (index >= mesh.vertices_m.size() || !is_finite(mesh.vertices_m[index])) continue;
      const Vec3 v = mesh.vertices_m[index];
      if (!any) box = {v, v};
      any = true;
      box.least_m = {std::min(box.least_m.x, v.x), std::min(box.least_m.y, v.y),
                     std::min(box.least_m.z, v.z)};
      box.most_m = {std::max(box.most_m.x, v.x), std::max(box.most_m.y, v.y), std::max(box.most_m.z, v.z)};
    }
  if (!any) return invalid_input("is a mesh without a finite triangle");
  return box;
}

/// Into the box of that size, standing on z = 0.
SceneFromInput fitted(const sculpt::Box& box, Vec3 size_m) {
  const Vec3 extent = box.most_m - box.least_m;
  double scale = 1e12;
  for (const auto& [have, want] :
       {std::pair(extent.x, size_m.x), std::pair(extent.y, size_m.y), std::pair(extent.z, size_m.z)})
    if (have > 0.0) scale = std::min(scale, want / have);
  SceneFromInput transform;
  transform.scale = scale;
  const Vec3 middle = 0.5 * (box.least_m + box.most_m);
  transform.translation_m = -scale * Vec3{middle.x, middle.y, box.least_m.z};
  return transform;
}

}  // namespace

Result<MadeScene> field_from_mesh_file(const MakeOptions& options, const std::filesystem::path& file,
                                       const Work& work) {
  work.report(0.0, "reading the mesh");
  auto mesh = sources::read_mesh(file);
  if (!mesh) return mesh.error();
  auto box = box_of(*mesh);
  if (!box) return at_place(box.error(), file);
  models::Scene scene;
  if (options.relief.size_m) {
    scene.scene_from_input = fitted(*box, *options.relief.size_m);
    const auto place = [&](Vec3 v) { return (scene.scene_from_input * Point<models::InputFrame>{v}).v; };
    for (Vec3& v : mesh->vertices_m) v = place(v);
    *box = {place(box->least_m), place(box->most_m)};
  }
  const auto cell_m = sculpt::finest_cell_m(*box, options.field);
  if (!cell_m) return at_place(cell_m.error(), file);
  const auto solid = sculpt::solid_from_mesh(*mesh, *cell_m, work);
  if (!solid) return at_place(solid.error(), file);
  auto distance = sculpt::field_from_source(*solid->distance, options.field, work);
  if (!distance) return at_place(distance.error(), file);
  const sculpt::Box surface = solid->distance->bounds();
  auto field = models::field_of(std::move(*distance), surface.least_m, surface.most_m);
  if (!field) return at_place(field.error(), file);
  scene.source.method = fmt::format("field of a mesh, {} cells, error bound {:.1f} um",
                                    options.field.resolution, 1e6 * field->distance.errors().bound_m);
  scene.source.inputs = {file.string()};
  scene.source.made_by = options.made_by;
  scene.model = std::make_shared<const models::Field>(std::move(*field));
  return MadeScene{std::make_shared<const models::Scene>(std::move(scene)), solid->repair.notes()};
}

}  // namespace palpable::session
