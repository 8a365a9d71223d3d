// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/field_recipe.hpp"

#include "palpable/models/relief/relief_solid.hpp"
#include "palpable/recipes/solid/field_scene.hpp"
#include "palpable/recipes/solid/volume_under_relief.hpp"
#include "palpable/sculpt/field/level_set_surface.hpp"
#include "palpable/sculpt/points/cloud_normals.hpp"

#include <utility>

namespace palpable::recipes {
Result<void> check(const FieldRecipe& recipe) {
  if (auto valid = check_ranges(recipe.field); !valid) return valid;
  if (auto valid = check_ranges(recipe.walls); !valid) return valid;
  if (auto valid = check_ranges(recipe.sheets); !valid) return valid;
  if (auto valid = check_ranges(recipe.prediction); !valid) return valid;
  return check_ranges(recipe.cloud);
}

Result<MadeScene> field_from_mesh(Mesh mesh, const FieldRecipe& recipe, const Work& work) {
  if (const auto valid = check(recipe); !valid) return valid.error();
  auto solid = solid_of(std::move(mesh), recipe, work);
  if (!solid) return solid.error();
  return field_scene(*std::move(solid), "mesh", recipe, work);
}

Result<MadeScene> field_from_points(PointCloud given, const FieldRecipe& recipe, const Work& work) {
  if (const auto valid = check(recipe); !valid) return valid.error();
  const bool estimated = given.normals.empty();
  auto cloud = estimated ? sculpt::with_normals(std::move(given), work) : Result(std::move(given));
  if (!cloud) return cloud.error();
  auto surface = sculpt::surface_of_cloud(*cloud, recipe.cloud, work);
  if (!surface) return surface.error();
  auto solid = solid_of(std::move(*surface), recipe, work);
  if (!solid) return solid.error();
  if (estimated)
    solid->notes.insert(solid->notes.begin(),
                        "The points have no normals: they were estimated from their neighbours and turned "
                        "outwards part by part, which may fail where an object is thin or was seen from one "
                        "side only.");
  return field_scene(*std::move(solid), "points", recipe, work);
}

Result<MadeScene> field_from_superquadrics(std::vector<models::Superquadric> shapes,
                                           const FieldRecipe& recipe, const Work& work) {
  if (const auto valid = check(recipe); !valid) return valid.error();
  auto solid = solid_of(std::move(shapes), recipe);
  if (!solid) return solid.error();
  return field_scene(*std::move(solid), "shapes", recipe, work);
}

Result<MadeScene> field_from_corrected_shapes(Mesh surface, std::vector<models::Superquadric> predicted,
                                              const FieldRecipe& recipe, const Work& work) {
  if (const auto valid = check(recipe); !valid) return valid.error();
  auto solid = solid_of(std::move(surface), recipe, work);
  if (!solid) return solid.error();
  for (models::Superquadric& shape : predicted) shape = placed_in_scene(shape, solid->scene_from_input);
  solid->primitives = std::move(predicted);
  return field_scene(*std::move(solid), "corrected shapes", recipe, work);
}

Result<MadeScene> field_from_level_set(const LevelSet& set, const FieldRecipe& recipe, const Work& work) {
  if (const auto valid = check(recipe); !valid) return valid.error();
  auto surface = sculpt::surface_of_level_set(set, work);
  if (!surface) return surface.error();
  // Interpolation between grid points displaces an edge by about this share of a voxel.
  constexpr double kVoxelError = 0.1;
  auto solid = solid_of_contour(std::move(*surface), kVoxelError * norm(set.steps_m[0]), recipe);
  if (!solid) return solid.error();
  return field_scene(*std::move(solid), "level-set", recipe, work);
}

Result<MadeScene> field_from_relief(MadeScene made, const FieldRecipe& given, const Work& work) {
  if (const auto valid = check(given); !valid) return valid.error();
  const auto relief = relief_to_fill(made.scene);
  if (!relief) return relief.error();
  FieldRecipe recipe = given;
  recipe.placement = {};
  auto whole = solid_of(models::solid_of(**relief), recipe, work);
  if (!whole) return whole.error();
  auto solid = with_surface(*std::move(whole), recipe, work);
  if (!solid) return solid.error();
  auto field = stored_field(*solid, recipe, work);
  if (!field) return field.error();
  made.scene.source.method += ", filled behind into a field" + solid->surface + ", " + field->method;
  made.scene.model = std::move(field->model);
  made.notes.insert(made.notes.end(), solid->notes.begin(), solid->notes.end());
  made.notes.insert(made.notes.end(), field->notes.begin(), field->notes.end());
  return made;
}

}  // namespace palpable::recipes
