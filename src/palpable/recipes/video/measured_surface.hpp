// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/recipes/video/video_model.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"

#include <vector>

namespace palpable::recipes {

/// How a depth map becomes the surface that it measured.
struct MeasuredSurfaceOptions {
  /// Spacing of the surface's corners, px, 1 … 64. Each is the mean of the pixels around it that lie on the
  /// same surface.
  int step_px = 3;
  /// Neighbouring corners are on different surfaces if their depths differ by more than this multiple of
  /// their distance across the line of sight, 1 … 50. 4 is a surface seen at 14 degrees.
  double most_slope = 4.0;
};
std::vector<Parameter> parameters_of(MeasuredSurfaceOptions& options);

/// The part of the model's surface that one frame saw, in the model's axes: Delaunay triangles (of a grid of
/// pixels), cut at depth steps, which face the camera. Triangles on the ground are left out.
Mesh measured_surface(const vision::FrameDepth& map, const VideoModel& model,
                      const MeasuredSurfaceOptions& options);

}  // namespace palpable::recipes
