// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/fused_depth_recipe.hpp"

#include "palpable/recipes/solid/field_scene.hpp"
#include "palpable/recipes/solid/world_orientation.hpp"
#include "palpable/sculpt/field/level_set_surface.hpp"
#include "palpable/sculpt/triangles/small_parts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

using WorldFromCamera = Transform<models::InputFrame, CameraFrame>;

/// Composition: first `turn`, a pure rotation, then `place`.
SceneFromInput composed(const SceneFromInput& turn, const SceneFromInput& place) {
  return place * Transform<models::InputFrame, models::InputFrame>{turn.rotation, {}, 1.0};
}

/// The surface of fused depth maps.
struct FusedSurface {
  Mesh mesh;
  double voxel_m = 0.0;
};

Result<FusedSurface> fused_surface(std::span<const sculpt::DepthView> views, const FusedDepthRecipe& recipe,
                                   int resolution, const Work& work) {
  sculpt::FusionOptions fusion = recipe.fusion;
  fusion.resolution = resolution;
  const auto set = sculpt::fused_depth(views, fusion, work);
  if (!set) return set.error();
  auto surface = sculpt::surface_of_level_set(*set, work);
  if (!surface) return surface.error();
  if (recipe.least_part > 0) *surface = sculpt::without_small_parts(*surface, recipe.least_part);
  return FusedSurface{*std::move(surface), norm(set->steps_m[0])};
}

/// The resolution at which a surface of so many triangles has as many as are allowed: their number grows with
/// the square of the resolution.
int resolution_for(std::size_t triangles, int resolution, const FusedDepthRecipe& recipe) {
  const auto most = static_cast<std::size_t>(recipe.most_triangles);
  if (most == 0 || triangles <= most) return resolution;
  const double share = static_cast<double>(most) / static_cast<double>(triangles);
  constexpr int kLeast = 64;
  return std::max(std::min(kLeast, resolution), static_cast<int>(std::sqrt(share) * resolution));
}

/// The solid of all views, placed as the recipe says, whose resolution may become lower.
Result<Solid> fused_solid(std::span<const sculpt::DepthView> views, FusedDepthRecipe& recipe,
                          const Work& work) {
  const int wanted = std::clamp(recipe.field.field.resolution, 16, recipe.fusion.resolution);
  auto surface = fused_surface(views, recipe, wanted, work);
  if (!surface) return surface.error();
  const int resolution = resolution_for(surface->mesh.triangles.size(), wanted, recipe);
  const bool rough = resolution < wanted;
  if (rough) {
    // Larger voxels also average more of the noise.
    recipe.field.field.resolution = resolution;
    surface = fused_surface(views, recipe, resolution, work);
    if (!surface) return surface.error();
  }
  // The noise of depth maps is at least this share of a voxel.
  constexpr double kVoxelError = 0.5;
  auto solid = solid_of_contour(std::move(surface->mesh), kVoxelError * surface->voxel_m, recipe.field);
  if (!solid) return solid.error();
  solid->notes.insert(
      solid->notes.begin(),
      Note(fmt::format("{} depth map{} fused in voxels of {:.3g} mm{}.", views.size(),
                       views.size() == 1 ? " was" : "s were",
                       1000.0 * surface->voxel_m * solid->scene_from_input.scale,
                       rough ? ", which are larger because the measured surface is rough" : "")));
  return solid;
}

}  // namespace

Result<MadeScene> field_from_depth_maps(const std::vector<PosedDepth>& given, const FusedDepthRecipe& recipe,
                                        const Work& work) {
  std::vector<Note> notes;
  SceneFromInput upright;
  std::vector<WorldFromCamera> world_from_cameras;
  world_from_cameras.reserve(given.size());
  for (const PosedDepth& view : given) world_from_cameras.push_back(view.world_from_camera);
  upright.rotation = scene_rotation_for(world_from_cameras);
  if (upright.rotation != SceneFromInput{}.rotation)
    notes.emplace_back(
        "The poses' world was turned by right angles: y is up, and the cameras look away from you.");
  std::vector<sculpt::DepthView> views;
  views.reserve(given.size());
  for (const PosedDepth& view : given) views.push_back({&view.depth, upright * view.world_from_camera});
  // Depth cameras give metres, and y is up after the rotation.
  FusedDepthRecipe upright_recipe = recipe;
  sculpt::PlacementOptions& placement = upright_recipe.field.placement;
  placement.default_size = sculpt::DefaultSize::own;
  placement.convention = {AxisDirection::plus_y, LengthUnit::metre};
  if (placement.size_m && placement.lay == sculpt::Lay::automatic) placement.lay = sculpt::Lay::upright;
  auto solid = fused_solid(views, upright_recipe, work);
  if (!solid) return solid.error();
  solid->scene_from_input = composed(upright, solid->scene_from_input);
  solid->notes.insert(solid->notes.begin(), notes.begin(), notes.end());
  FieldRecipe field = recipe.field;
  field.field.resolution = upright_recipe.field.field.resolution;
  return field_scene(*std::move(solid), "depth", field, work);
}

Result<MadeScene> field_from_views(std::span<const sculpt::DepthView> views, const FusedDepthRecipe& recipe,
                                   const std::string& input, const Work& work) {
  FusedDepthRecipe used = recipe;
  auto solid = fused_solid(views, used, work);
  if (!solid) return solid.error();
  return field_scene(*std::move(solid), input, used.field, work);
}

}  // namespace palpable::recipes
