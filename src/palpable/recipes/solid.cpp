// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid.hpp"

#include "palpable/core/memory.hpp"
#include "palpable/recipes/placement_notes.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

/// The bounding box of the finite vertices of triangles.
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

struct Placed {
  SceneFromInput scene_from_input;
  models::SolidPose pose = models::SolidPose::upright;
  std::vector<Note> notes;
};

models::SolidPose pose_of(const sculpt::Placement& placement) {
  return placement.lay == sculpt::Lay::flat ? models::SolidPose::flat : models::SolidPose::upright;
}

/// Transforms a mesh into the scene.
Result<Placed> place_mesh(Mesh& mesh, const sculpt::PlacementOptions& options) {
  const auto box = box_of(mesh);
  if (!box) return box.error();
  const AxisDirection up = options.up.value_or(options.convention.up);
  const auto placement = sculpt::placement_of(*box, options, sculpt::level_share(mesh, up));
  if (!placement) return placement.error();
  const SceneFromInput& transform = placement->scene_from_input;
  if (placement->fitted)
    for (Vec3& v : mesh.vertices_m) v = (transform * Point<models::InputFrame>{v}).v;
  return Placed{transform, pose_of(*placement), placement_notes(*placement, *box, options)};
}

/// Refuses a field that is too large by its extent alone, before any other work.
Result<void> check_size(const sculpt::Box& box, const FieldRecipe& recipe) {
  if (recipe.storage == FieldStorage::adaptive) return {};
  const auto lattice = sculpt::lattice_around(box, dense_options(recipe));
  if (!lattice) return lattice.error();
  return {};
}

models::Superquadric placed(models::Superquadric shape, const SceneFromInput& transform) {
  auto& scene_from_shape = shape.scene_from_shape;
  const Transform<SceneFrame, SceneFrame> turned{transform.rotation, {}, 1.0};
  const Vec3 at_m = (transform * Point<models::InputFrame>{scene_from_shape.translation_m}).v;
  scene_from_shape = turned * scene_from_shape;
  scene_from_shape.translation_m = at_m;
  shape.size_m *= transform.scale;
  shape.bend_per_m /= transform.scale;
  return shape;
}

/// States the greatest error too: in a badly repaired mesh a few places may be far off although 99 % are
/// not.
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

Result<StoredField> stored_densely(const Solid& solid, const FieldRecipe& recipe, const Work& work) {
  auto distance = sculpt::dense_field_from_source(*solid.distance, dense_options(recipe), work);
  if (!distance) return distance.error();
  auto model = model_of(*std::move(distance), solid);
  if (!model) return model.error();
  const bool paper = recipe.storage == FieldStorage::paper;
  return StoredField{*std::move(model),
                     fmt::format("{} cells, dense{}", recipe.field.resolution,
                                 paper ? ", distance and force by fast marching" : ""),
                     {}};
}

}  // namespace

sculpt::DenseFieldOptions dense_options(const FieldRecipe& recipe) {
  sculpt::DenseFieldOptions dense;
  if (recipe.storage == FieldStorage::paper) dense.content = models::DenseContent::distance_and_force;
  dense.resolution = recipe.field.resolution;
  return dense;
}

Result<Solid> solid_of(Mesh mesh, const FieldRecipe& recipe, const Work& work) {
  auto place = place_mesh(mesh, recipe.placement);
  if (!place) return place.error();
  Solid solid;
  solid.scene_from_input = place->scene_from_input;
  solid.pose = place->pose;
  solid.notes = std::move(place->notes);
  const auto box = box_of(mesh);
  if (!box) return box.error();
  if (const auto fits = check_size(*box, recipe); !fits) return fits.error();
  const auto cell_m = sculpt::finest_cell_m(*box, recipe.field);
  if (!cell_m) return cell_m.error();
  if (const auto free_bytes = available_memory_bytes())
    if (auto refused = sculpt::mesh_too_large(mesh.triangles.size(), *free_bytes)) return *std::move(refused);
  // Dense fields, which are for comparison, keep the triangles unchanged.
  sculpt::FacetOptions facets;
  if (recipe.storage == FieldStorage::adaptive)
    facets.rounding_m = sculpt::facet_rounding_m(*box, recipe.field);
  sculpt::WallOptions walls =
      recipe.storage == FieldStorage::adaptive ? recipe.walls : sculpt::kWallsAsTheyAre;
  walls.up = place->pose == models::SolidPose::flat ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  auto made = sculpt::solid_from_mesh(mesh, *cell_m, work, facets, walls, recipe.sheets);
  if (!made) return made.error();
  solid.distance = std::move(made->distance);
  const auto notes = made->repair.notes();
  solid.notes.insert(solid.notes.end(), notes.begin(), notes.end());
  return solid;
}

Result<Solid> solid_of(std::vector<models::Superquadric> shapes, const FieldRecipe& recipe) {
  auto distance = sculpt::distance_of(shapes);
  if (!distance) return distance.error();
  Solid solid;
  const sculpt::Box box = (*distance)->bounds();
  const auto placement = sculpt::placement_of(box, recipe.placement);
  if (!placement) return placement.error();
  solid.notes = placement_notes(*placement, box, recipe.placement);
  solid.pose = pose_of(*placement);
  if (placement->fitted) {
    solid.scene_from_input = placement->scene_from_input;
    for (models::Superquadric& shape : shapes) shape = placed(shape, solid.scene_from_input);
    distance = sculpt::distance_of(shapes);
    if (!distance) return distance.error();
  }
  solid.distance = std::move(*distance);
  solid.primitives = std::move(shapes);
  return solid;
}

Result<Solid> solid_of_contour(Mesh surface, double exact_to_m, const FieldRecipe& recipe) {
  auto place = place_mesh(surface, recipe.placement);
  if (!place) return place.error();
  const auto box = box_of(surface);
  if (!box) return box.error();
  if (const auto fits = check_size(*box, recipe); !fits) return fits.error();
  auto distance = sculpt::solid_from_contour(surface);
  if (!distance) return distance.error();
  Solid solid;
  solid.distance = std::move(*distance);
  solid.exact_to_m = place->scene_from_input.scale * exact_to_m;
  solid.scene_from_input = place->scene_from_input;
  solid.pose = place->pose;
  solid.notes = std::move(place->notes);
  return solid;
}

Result<StoredField> stored_field(const Solid& solid, const FieldRecipe& recipe, const Work& work) {
  if (recipe.storage != FieldStorage::adaptive) return stored_densely(solid, recipe, work);
  sculpt::FieldOptions field_options = recipe.field;
  if (field_options.max_error_m == 0.0 && solid.exact_to_m > 0.0)
    field_options.max_error_m = solid.exact_to_m;
  // Parts, tree and the hash table of leaves exist at the same time.
  constexpr std::size_t kWhileBuilding = 4;
  if (const auto free_bytes = available_memory_bytes())
    field_options.most_bytes = std::min(field_options.most_bytes, *free_bytes / kWhileBuilding);
  auto distance = sculpt::field_from_source(*solid.distance, field_options, work);
  if (!distance) return distance.error();
  const models::FieldErrors errors = distance->errors();
  auto model = model_of(*std::move(distance), solid);
  if (!model) return model.error();
  return StoredField{
      *std::move(model),
      fmt::format("{} cells, error bound {:.1f} um", field_options.resolution, 1e6 * errors.bound_m),
      {note_on(errors)}};
}

Result<MadeScene> field_scene(Solid solid, const std::string& input, const FieldRecipe& recipe,
                              const Work& work) {
  auto field = stored_field(solid, recipe, work);
  if (!field) return field.error();
  models::Scene scene;
  scene.scene_from_input = solid.scene_from_input;
  scene.pose = solid.pose;
  scene.source.method = fmt::format("field of {}, {}", input, field->method);
  scene.model = std::move(field->model);
  std::vector<Note> notes = std::move(solid.notes);
  notes.insert(notes.end(), field->notes.begin(), field->notes.end());
  return MadeScene{std::move(scene), std::move(notes)};
}

}  // namespace palpable::recipes
