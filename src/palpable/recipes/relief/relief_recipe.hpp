// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/sculpt/relief/relief_from_depth.hpp"
#include "palpable/vision/depth_camera/smooth_depth.hpp"
#include "palpable/vision/segmentation/background.hpp"
#include "palpable/vision/segmentation/ground.hpp"
#include "palpable/vision/stereo/methods/stereo_options.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <optional>
#include <variant>
#include <vector>

namespace palpable::recipes {

/// The picture on a relief.
enum class Texture {
  /// The input's own: of a pair the left one.
  left,
  /// Of a pair: the view from between the cameras, synthesised from both pictures and the depth (Shi & Pai
  /// 1997). The relief has the shape of that view too.
  front,
  none
};

/// How the background of a scene is treated.
enum class BackgroundTreatment {
  keep,
  /// It is lowered to the farthest depth that remains.
  remove
};

/// How depth becomes a relief scene. The defaults are the same for every picture.
struct ReliefRecipe {
  sculpt::ReliefOptions relief;
  /// How metric depth is freed from a depth camera's noise.
  vision::SmoothDepthOptions depth_camera;
  /// The plane that the objects stand on.
  vision::GroundTreatment ground = vision::GroundTreatment::keep;
  vision::GroundOptions ground_options;
  BackgroundTreatment background = BackgroundTreatment::keep;
  vision::BackgroundMaskOptions background_options;
  Texture texture = Texture::left;
  /// A relief that keeps the order of a smaller share of pairs, any or near each other
  /// (sculpt/relief/depth_order.hpp), gets a warning. 0 … 1.
  double least_kept_order = 0.9;
};

/// Errors: usage for options of ground or background, or least_kept_order, out of range.
Result<void> check(const ReliefRecipe& recipe);

/// How a pair is matched.
struct StereoRecipe {
  /// Not given: default_method().
  std::optional<vision::StereoMethod> method;
  vision::StereoOptions options;
};

/// Depth that was measured, rendered or drawn.
struct DepthInput {
  /// Metres if they are known; else disparity or nearness, of which only the shape is used.
  std::variant<DepthMap, DisparityMap> depth;
  /// The picture of the same pixels.
  std::optional<Image> colour;
};

/// The stereo method with the smallest errors.
vision::StereoMethod default_method();

/// The methods for a touch that begins at once, in their order: a fast one and then default_method(), or
/// only the given one.
std::vector<vision::StereoMethod> progressive_methods(const StereoRecipe& stereo);

/// A relief from a rectified pair. Long work: reports progress, polls cancel. Any thread. Errors: as
/// vision::match() and sculpt::relief_from_disparity(), without a place; interrupted.
Result<MadeScene> relief_from_pair(const vision::StereoPair& pair, const StereoRecipe& stereo,
                                   const ReliefRecipe& recipe, const Work& work);

/// A relief from one depth map; of metric depth, the noise of a depth camera is smoothed first
/// (vision::smooth_depth()), with a note. Long work, any thread. Errors: as sculpt::relief_from_depth(),
/// without a place.
Result<MadeScene> relief_from_depth(DepthInput input, const ReliefRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
