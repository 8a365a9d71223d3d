// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/make_field.hpp"

#include "palpable/core/memory.hpp"
#include "palpable/formats/scene/superquadric_json.hpp"
#include "palpable/formats/vdb/vdb.hpp"
#include "palpable/models/relief/relief_solid.hpp"
#include "palpable/sculpt/field/dense_field_from_source.hpp"
#include "palpable/sculpt/field/level_set_surface.hpp"
#include "palpable/sculpt/points/cloud_normals.hpp"
#include "palpable/sculpt/points/cloud_surface.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/session/make/fuse_frames.hpp"
#include "palpable/session/make/places.hpp"
#include "palpable/sources/solid/mesh_file.hpp"
#include "palpable/sources/solid/points_file.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::session {
namespace {

using SceneFromInput = Transform<SceneFrame, models::InputFrame>;

/// Of the finite vertices that a triangle uses.
Result<sculpt::Box> box_of(const Mesh& mesh) {
  std::optional<sculpt::Box> box;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t index : t) {
      if (index >= mesh.vertices_m.size() || !is_finite(mesh.vertices_m[index])) continue;
      if (!box) box = {mesh.vertices_m[index], mesh.vertices_m[index]};
      box->grow(mesh.vertices_m[index]);
    }
  if (!box) return invalid_input("is a mesh without a finite triangle");
  return *box;
}

/// First the one, which neither scales nor moves, then the other.
SceneFromInput then(const SceneFromInput& turn, const SceneFromInput& place) {
  SceneFromInput both = place;
  both.rotation = turn.rotation;
  return both;
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

/// What a field is sampled from, and what it is to be told with.
struct Solid {
  std::unique_ptr<sculpt::DistanceSource> distance;
  std::vector<std::string> notes;
  SceneFromInput scene_from_input;
  /// How exactly the input itself tells its surface; 0 = as exactly as is asked for.
  double exact_to_m = 0.0;
  /// As they stand in the scene, where it consists of some.
  std::vector<models::Superquadric> primitives;
};

/// Scales a mesh into that box, if one is given, and says how.
Result<SceneFromInput> place_mesh(Mesh& mesh, const std::optional<Vec3>& size_m) {
  const auto box = box_of(mesh);
  if (!box) return box.error();
  if (!size_m) return SceneFromInput{};
  const SceneFromInput transform = fitted(*box, *size_m);
  for (Vec3& v : mesh.vertices_m) v = (transform * Point<models::InputFrame>{v}).v;
  return transform;
}

sculpt::DenseFieldOptions dense_options(const MakeOptions& options) {
  sculpt::DenseFieldOptions dense;
  if (options.field_keeping == FieldKeeping::paper) dense.content = models::DenseContent::distance_and_force;
  dense.resolution = options.field.resolution;
  return dense;
}

/// Refuses what is known to be too large from its extent alone, before anything else is done.
Result<void> check_size(const sculpt::Box& box, const MakeOptions& options) {
  if (options.field_keeping == FieldKeeping::adaptive) return {};
  const auto lattice = sculpt::lattice_around(box, dense_options(options));
  if (!lattice) return lattice.error();
  return {};
}

Result<Solid> solid_of(Mesh mesh, const std::optional<Vec3>& size_m, const MakeOptions& options,
                       const Work& work) {
  const auto transform = place_mesh(mesh, size_m);
  if (!transform) return transform.error();
  Solid solid;
  solid.scene_from_input = *transform;
  const auto box = box_of(mesh);
  if (!box) return box.error();
  if (const auto fits = check_size(*box, options); !fits) return fits.error();
  const auto cell_m = sculpt::finest_cell_m(*box, options.field);
  if (!cell_m) return cell_m.error();
  if (const auto free_bytes = available_memory_bytes())
    if (auto refused = sculpt::mesh_too_large(mesh.triangles.size(), *free_bytes)) return *std::move(refused);
  // The dense ways are there to be compared with: they keep the triangles as they are.
  const double rounding_m =
      options.field_keeping == FieldKeeping::adaptive ? sculpt::facet_rounding_m(*box, options.field) : 0.0;
  auto made = sculpt::solid_from_mesh(mesh, *cell_m, work, rounding_m);
  if (!made) return made.error();
  solid.distance = std::move(made->distance);
  solid.notes = made->repair.notes();
  return solid;
}

/// Scaled and moved as the transform says, which does not turn.
models::Superquadric placed(models::Superquadric shape, const SceneFromInput& transform) {
  Vec3& at_m = shape.scene_from_shape.translation_m;
  at_m = transform.scale * at_m + transform.translation_m;
  shape.size_m *= transform.scale;
  shape.bend_per_m /= transform.scale;
  return shape;
}

Result<Solid> solid_of(std::vector<models::Superquadric> shapes, const std::optional<Vec3>& size_m) {
  auto distance = sculpt::distance_of(shapes);
  if (!distance) return distance.error();
  Solid solid;
  if (size_m) {
    solid.scene_from_input = fitted((*distance)->bounds(), *size_m);
    for (models::Superquadric& shape : shapes) shape = placed(shape, solid.scene_from_input);
    distance = sculpt::distance_of(shapes);
    if (!distance) return distance.error();
  }
  solid.distance = std::move(*distance);
  solid.primitives = std::move(shapes);
  return solid;
}

/// From a contour of voxels, which tells its surface to `exact_to_m` of the input.
Result<Solid> solid_of_contour(Mesh surface, double exact_to_m, const MakeOptions& options) {
  const auto transform = place_mesh(surface, options.relief.size_m);
  if (!transform) return transform.error();
  const auto box = box_of(surface);
  if (!box) return box.error();
  if (const auto fits = check_size(*box, options); !fits) return fits.error();
  auto distance = sculpt::solid_from_contour(surface);
  if (!distance) return distance.error();
  Solid solid;
  solid.distance = std::move(*distance);
  solid.scene_from_input = *transform;
  solid.exact_to_m = transform->scale * exact_to_m;
  return solid;
}

Result<Solid> solid_from_level_set(const std::filesystem::path& file, const MakeOptions& options,
                                   const Work& work) {
  const auto set = formats::read_vdb(file);
  if (!set) return set.error();
  auto surface = sculpt::surface_of_level_set(*set, work);
  if (!surface) return surface.error();
  // Between places of a grid an edge is lost by about so much.
  constexpr double kOfAVoxel = 0.1;
  return solid_of_contour(std::move(*surface), kOfAVoxel * norm(set->steps_m[0]), options);
}

Result<Solid> solid_from_frames(const MakeOptions& options, const Work& work) {
  auto fused = fused_surface(options, work);
  if (!fused) return fused.error();
  // The noise of depth cameras is no finer.
  constexpr double kOfAVoxel = 0.5;
  auto solid = solid_of_contour(std::move(fused->surface), kOfAVoxel * fused->voxel_m, options);
  if (!solid) return at_place(solid.error(), options.inputs.front());
  solid->scene_from_input = then(fused->scene_from_input, solid->scene_from_input);
  solid->notes = std::move(fused->notes);
  return solid;
}

Result<Solid> solid_from_points(const std::filesystem::path& file, const MakeOptions& options,
                                const Work& work) {
  auto cloud = sources::read_points(file);
  if (!cloud) return cloud.error();
  const bool estimated = cloud->normals.empty();
  if (estimated) {
    cloud = sculpt::with_normals(*std::move(cloud), work);
    if (!cloud) return cloud.error();
  }
  auto surface = sculpt::surface_of_cloud(*cloud, {}, work);
  if (!surface) return surface.error();
  auto solid = solid_of(std::move(*surface), options.relief.size_m, options, work);
  if (solid && estimated)
    solid->notes.insert(solid->notes.begin(),
                        "The points have no normals: they were estimated from their neighbours and turned "
                        "outwards part by part, which may fail where a thing is thin or was seen from one "
                        "side only.");
  return solid;
}

Result<Solid> solid_from_file(const MakeOptions& options, const sources::Input& input, const Work& work) {
  const auto& file = input.files.front();
  const auto& size_m = options.relief.size_m;
  work.report(0.0, "reading the solid");
  if (input.kind == sources::InputKind::shapes) {
    auto shapes = formats::read_superquadrics(file);
    if (!shapes) return shapes.error();
    return solid_of(std::move(*shapes), size_m);
  }
  if (input.kind == sources::InputKind::points) {
    return solid_from_points(file, options, work);
  }
  if (input.kind == sources::InputKind::level_set) return solid_from_level_set(file, options, work);
  if (input.kind == sources::InputKind::depth) return solid_from_frames(options, work);
  auto mesh = sources::read_mesh(file);
  if (!mesh) return mesh.error();
  return solid_of(std::move(*mesh), size_m, options, work);
}

/// A solid's field, and in words how it is kept.
struct Sampled {
  models::Model model;
  std::string method;
  /// One sentence each, for the person.
  std::vector<std::string> notes;
};

/// The greatest error is of one place: of a mesh that was repaired badly it shows what the 99 % hide.
std::string note_on(const models::FieldErrors& errors) {
  return fmt::format(
      "The field's measured error near the surface is at most {:.0f} um; 99 % of it is below {:.1f} um.",
      1e6 * errors.max_m, 1e6 * errors.p99_m);
}

template <class Distance>
Result<models::Model> model_of(Distance distance, const Solid& solid) {
  const sculpt::Box surface = solid.distance->bounds();
  auto field = models::field_of(std::move(distance), surface.least_m, surface.most_m);
  if (!field) return field.error();
  field->primitives = solid.primitives;
  return models::Model(std::make_shared<const models::SolidField<Distance>>(*std::move(field)));
}

Result<Sampled> sampled_densely(const Solid& solid, const MakeOptions& options, const Work& work) {
  auto distance = sculpt::dense_field_from_source(*solid.distance, dense_options(options), work);
  if (!distance) return distance.error();
  auto model = model_of(*std::move(distance), solid);
  if (!model) return model.error();
  const bool paper = options.field_keeping == FieldKeeping::paper;
  return Sampled{*std::move(model),
                 fmt::format("{} cells, dense{}", options.field.resolution,
                             paper ? ", distance and force by fast marching" : ""),
                 {}};
}

Result<Sampled> sampled(const Solid& solid, const MakeOptions& options, const Work& work) {
  if (options.field_keeping != FieldKeeping::adaptive) return sampled_densely(solid, options, work);
  sculpt::FieldOptions field_options = options.field;
  if (field_options.max_error_m == 0.0 && solid.exact_to_m > 0.0)
    field_options.max_error_m = solid.exact_to_m;
  // Parts, tree and what tells which leaves are the same stand at a time.
  constexpr std::size_t kWhileBuilding = 4;
  if (const auto free_bytes = available_memory_bytes())
    field_options.most_bytes = std::min(field_options.most_bytes, *free_bytes / kWhileBuilding);
  auto distance = sculpt::field_from_source(*solid.distance, field_options, work);
  if (!distance) return distance.error();
  const models::FieldErrors errors = distance->errors();
  auto model = model_of(*std::move(distance), solid);
  if (!model) return model.error();
  return Sampled{
      *std::move(model),
      fmt::format("{} cells, error bound {:.1f} um", field_options.resolution, 1e6 * errors.bound_m),
      {note_on(errors)}};
}

}  // namespace

Result<MadeScene> field_from_file(const MakeOptions& options, const sources::Input& input, const Work& work) {
  const auto& file = input.files.front();
  auto solid = solid_from_file(options, input, work);
  if (!solid) return at_place(solid.error(), file);
  auto field = sampled(*solid, options, work);
  if (!field) return at_place(field.error(), file);
  models::Scene scene;
  scene.scene_from_input = solid->scene_from_input;
  scene.source.method = fmt::format("field of {}, {}", sources::name_of(input.kind), field->method);
  for (const auto& name : input.files) scene.source.inputs.push_back(name.string());
  scene.source.made_by = options.made_by;
  scene.model = std::move(field->model);
  std::vector<std::string> notes = std::move(solid->notes);
  notes.insert(notes.end(), field->notes.begin(), field->notes.end());
  return MadeScene{std::make_shared<const models::Scene>(std::move(scene)), std::move(notes)};
}

Result<MadeScene> field_from_relief(const MadeScene& made, const models::Relief& relief,
                                    const MakeOptions& options, const Work& work) {
  auto solid = solid_of(models::solid_of(relief), std::nullopt, options, work);
  if (!solid) return solid.error();
  auto field = sampled(*solid, options, work);
  if (!field) return field.error();
  models::Scene scene = *made.scene;
  scene.source.method += ", filled behind into a field, " + field->method;
  scene.model = std::move(field->model);
  std::vector<std::string> notes = made.notes;
  notes.insert(notes.end(), solid->notes.begin(), solid->notes.end());
  notes.insert(notes.end(), field->notes.begin(), field->notes.end());
  return MadeScene{std::make_shared<const models::Scene>(std::move(scene)), std::move(notes)};
}

}  // namespace palpable::session
