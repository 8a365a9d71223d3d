// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/sculpt/points/depth_fusion.hpp"

#include <span>
#include <string>
#include <vector>

namespace palpable::recipes {

/// One of several depth maps of the same scene. Its camera must be known.
struct PosedDepth {
  DepthMap depth;
  /// Camera x right, y down, z forward; metres.
  Transform<models::InputFrame, CameraFrame> world_from_camera;
};

/// How several depth maps become one field.
struct FusedDepthRecipe {
  /// fusion.resolution is at most that of the field.
  sculpt::FusionOptions fusion;
  FieldRecipe field;
  /// Parts of the surface whose longest side is shorter than this share of the whole are left out, 0 (none) …
  /// 1.
  double least_part = 0.0;
  /// A surface with more triangles is rough: it is fused again in voxels that are so large that it has about
  /// as many, and the field's finest cells are no smaller; 0 = never.
  int most_triangles = 0;
};

/// The field of the solid that several depth maps show, closed by filling behind the surfaces. The scene is
/// the poses' world, rotated by right angles if its cameras do not look along -z with y up
/// (scene_rotation_for). Long work, any thread. Errors, without a place: as sculpt::fused_depth() and
/// field_from_level_set().
Result<MadeScene> field_from_depth_maps(const std::vector<PosedDepth>& views, const FusedDepthRecipe& recipe,
                                        const Work& work);

/// The same from views in axes of their own, which recipe.field.placement describes. `input` names them in
/// the scene's provenance.
Result<MadeScene> field_from_views(std::span<const sculpt::DepthView> views, const FusedDepthRecipe& recipe,
                                   const std::string& input, const Work& work);

}  // namespace palpable::recipes
