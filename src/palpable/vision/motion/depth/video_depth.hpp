// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/depth/depth_filling.hpp"
#include "palpable/vision/motion/depth/multi_view_depth.hpp"
#include "palpable/vision/motion/structure/camera_motion.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

struct VideoDepthOptions {
  /// Number of frames whose depth is computed, evenly spaced along the video, 2 … 200.
  int maps = 14;
  /// Each is compared with earlier and later frames whose viewing directions of the scene's centre differ by
  /// these angles, degrees, 0.2 … 30. Near the video's ends, frames on the other side take the place of those
  /// that are missing: at half of the nearer angle, and at the mean of the two.
  double near_angle_deg = 3.5;
  double far_angle_deg = 7.0;
  /// Depths are searched between those of the structure without this share at each end, 0 … 0.2 …
  double range_outliers = 0.005;
  /// … and this share of them nearer and farther, 0 … 0.9 …
  double range_margin = 0.2;
  /// … and beyond the structure in favoured planes, under which a scene that stands on the ground ends.
  double favoured_margin = 0.05;
  /// Surfaces that are parallel to these planes are favoured, such as the ground and what lies level on it:
  /// their normal in the world, either way; zero: none are.
  Vec3 favoured_normal = {};
  /// 1: planes that face the camera are tried too, for twice the time; without them slanted walls are worse
  /// (docs/history/2026-11-26-third-video.md). They always are where no others are favoured.
  int facing_too = 1;
  /// The planes are turned towards the camera until the line of sight of no pixel is so close to them, the
  /// product with the normal as a share of that in the middle, 0.01 … 1.
  double least_incidence = 0.2;
  /// Frames whose depth is computed in addition, indices.
  std::vector<int> also = {};
  MultiViewOptions sweep = {};
  ConsistencyOptions consistency = {};
  FillingOptions filling = {};
};
std::vector<Parameter> parameters_of(VideoDepthOptions& options);

/// The depth of one frame.
struct FrameDepth {
  int frame = 0;
  /// What other maps agree with: the surfaces are made of it.
  PosedDepthMap map;
  /// The same, with what other maps measured where it is unknown (filled_depth()).
  DepthMap filled = {};
};

/// Computes depth maps of frames of a video with known poses (multi_view_depth()), keeps the pixels on which
/// they agree (consistent_depth()), and fills the others (filled_depth()); in the unit of the poses.
/// `pictures`: one for each pose, of the camera's size. Long work: reports progress, polls cancel. Errors:
/// usage for options out of range; invalid_input if fewer than two frames can be compared with others;
/// interrupted.
Result<std::vector<FrameDepth>> depth_of_video(std::span<const Raster<Rgb8>* const> pictures,
                                               const CameraMotion& motion, const Pinhole& camera,
                                               const VideoDepthOptions& options, const Work& work);

}  // namespace palpable::vision
