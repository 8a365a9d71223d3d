// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/recipes/video/video_recipe.hpp"

#include <vector>

namespace palpable::recipes {

struct VideoColourOptions {
  /// A vertex is visible in a frame if its depth there differs from the frame's by less than this share,
  /// 0.001 … 0.2.
  double depth_tolerance = 0.02;
  /// It is not visible where the cosine between its normal and the line of sight is less than this, 0 … 1.
  double least_facing = 0.05;
  /// Times that colours spread to neighbours that no frame saw, 0 … 1000.
  int spread_times = 60;
};
std::vector<Parameter> parameters_of(VideoColourOptions& options);

/// The colours of a scene's surface as the frames of its depth maps show it: for each vertex their mean,
/// weighted by the cosine between viewing direction and normal. Vertices that no frame saw get the colours of
/// their neighbours, the rest is grey. `mesh`: in the scene's frame.
std::vector<Rgb8> colours_of(const Mesh& mesh, const VideoReconstruction& video,
                             const VideoColourOptions& options);

}  // namespace palpable::recipes
