// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/recipes/video/ground_axes.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::recipes {

/// Which part of what a video shows is the model, and where the ground is.
struct VideoModelOptions {
  GroundAxesOptions axes;
  /// Structure points are taken from each depth map at this spacing, px, 1 … 64.
  int structure_step_px = 4;
  /// Share of the points at each end of the model's extent that count as outliers, 0 … 0.2.
  double outliers = 0.01;
  /// The same below the ground and above the model, where fewer are, 0 … 0.2.
  double outliers_below = 0.005, outliers_above = 0.001;
  /// Share of the points at each end that are left out of the extent in which heights are measured, 0 … 0.4.
  double extent_outliers = 0.05;
  /// Where a smaller share of the points rises above the ground, all points are the model, 0 … 1.
  double least_raised = 0.01;
  /// Margin around the model, share of its extent, 0 … 2.
  double margin = 0.15;
  /// Points so far above the ground, as a share of its extent, belong to the model, 0.001 … 0.5 …
  double least_rise = 0.02;
  /// … and at least so many standard deviations of the ground's own heights, 0 … 20.
  double rise_noises = 4.0;
  /// Heights within this many standard deviations of the ground are noise and become the ground, if this is
  /// less than the least rise; up to twice of that they blend into what was measured. 0 … 20; 0 = none.
  double flat_noises = 3.0;
  /// The ground is the narrowest interval of heights with this share of the points, 0.05 … 0.9.
  double ground_share = 0.3;
};
std::vector<Parameter> parameters_of(VideoModelOptions& options);

/// A model on the ground, in the ground's axes (ground_axes.hpp) with the origin in its middle on the ground,
/// in the unit of the poses.
struct VideoModel {
  GroundAxes axes;
  /// Points on all surfaces that were seen, in the poses' world.
  PointCloud structure;
  double ground_height = 0.0;
  /// Standard deviation of the ground's measured heights: the noise of the depth maps, and a cloth's folds.
  double ground_noise = 0.0;
  /// Points above this height belong to the model; everything does where hardly anything rises.
  double raised_above = 0.0;
  /// The box of the model and of the ground around it.
  Vec3 least, most;
  /// Points of the model inside the box, above the ground; all points where hardly anything rises above it.
  std::vector<Vec3> raised;
};

/// Finds the ground and the model on it. Empty structure where the maps know nothing.
VideoModel video_model(std::span<const vision::FrameDepth> maps, const VideoModelOptions& options,
                       std::uint64_t seed);

/// The points of one depth map that belong to the model, in its axes, at a spacing of `step_px`.
std::vector<Vec3> raised_points(const vision::FrameDepth& map, const VideoModel& model, int step_px);

/// The position in the world of a pixel with a known depth.
Point<WorldFrame> place_of_pixel(const vision::FrameDepth& map, int x, int y);

/// Moves depths that lie on the ground but for its noise onto its plane, along their lines of sight, so that
/// a table does not become a relief. A ground that is no plane (a garden) stays as it was measured.
void flatten_ground(std::span<vision::FrameDepth> maps, const VideoModel& model,
                    const VideoModelOptions& options);

/// Depths outside the model's box become unknown.
void crop(std::span<vision::FrameDepth> maps, const VideoModel& model);

}  // namespace palpable::recipes
