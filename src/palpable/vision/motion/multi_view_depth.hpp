// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/image.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/motion/camera_motion.hpp"
#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/cost/sgm.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

/// A frame whose camera is known. The picture must outlive it.
struct PosedFrame {
  const Raster<Rgb8>* picture = nullptr;
  CameraPose pose;
};

/// The depths that a scene has, in the unit of the poses; 0 < near < far.
struct DepthSpan {
  double near = 0.0;
  double far = 0.0;
};

struct MultiViewOptions {
  /// Inverse depths are tried in steps that move a pixel so far in the frame where it moves most, px, 0.2
  /// … 4.
  double step_px = 0.7;
  /// But at most so many, 16 … 1024.
  int most_steps = 256;
  /// Share of the other frames, those in which a pixel matches best, that count: a surface is hidden in some
  /// of them; 0.1 … 1.
  double seen_share = 0.5;
  VolumeOptions volume = {};
  SgmOptions sgm = {};
};
std::vector<Parameter> parameters_of(MultiViewOptions& options);

/// The depth of `reference` by comparing it with other frames at planes of constant depth (plane sweep,
/// Collins 1996; AD-Census costs, semi-global paths): known at every pixel, also where it is wrong; see
/// consistent_depth(). All pictures have the camera's size. Long work, on all threads. Errors: usage for
/// options out of range, no other frame, or an empty span; interrupted.
Result<DepthMap> multi_view_depth(const PosedFrame& reference, std::span<const PosedFrame> others,
                                  const Pinhole& camera, DepthSpan span, const MultiViewOptions& options,
                                  const Work& work);

/// A depth map and the pose of its camera.
struct PosedDepthMap {
  DepthMap depth;
  CameraPose pose;
};

struct ConsistencyOptions {
  /// Depths that differ by less than this share agree, 0.0005 … 0.1.
  double tolerance = 0.01;
  /// A pixel needs so many other maps that agree, 1 … 16.
  int least_agreeing = 2;
};
std::vector<Parameter> parameters_of(ConsistencyOptions& options);

/// The maps with only those pixels on which enough other maps agree, each the mean of the agreeing depths;
/// the others become unknown. Errors: usage for options out of range; interrupted.
Result<std::vector<PosedDepthMap>> consistent_depth(std::span<const PosedDepthMap> maps,
                                                    const ConsistencyOptions& options, const Work& work);

}  // namespace palpable::vision
