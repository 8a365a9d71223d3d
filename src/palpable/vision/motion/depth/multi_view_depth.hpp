// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/motion/structure/camera_motion.hpp"
#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/cost/sgm.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

/// A frame with a known pose. The picture must outlive it.
struct PosedFrame {
  const Raster<Rgb8>* picture = nullptr;
  CameraPose pose;
};

/// The parallel planes that are tried as surfaces of a scene: dot(normal, p) = distance in the camera's
/// frame, distances from near to far, in the unit of the poses; 0 < near < far. The normal is a unit vector
/// that has a positive product with the line of sight of every pixel; (0, 0, 1) gives planes of constant
/// depth.
struct SweptPlanes {
  double near = 0.0;
  double far = 0.0;
  Vec3 normal{0, 0, 1};
};

struct MultiViewOptions {
  /// Step of the tried inverse depths, as the movement of a pixel in the frame in which it moves most, px,
  /// 0.2 … 4.
  double step_px = 0.7;
  /// Greatest number of steps, 16 … 1024.
  int most_steps = 256;
  /// Share of the other frames that count, those in which a pixel matches best, since a surface is occluded
  /// in some of them; 0.1 … 1.
  double seen_share = 0.5;
  VolumeOptions volume = {};
  SgmOptions sgm = {};
};
std::vector<Parameter> parameters_of(MultiViewOptions& options);

/// Computes the depth of `reference` by plane sweep (Collins 1996) with AD-Census costs and semi-global
/// aggregation, which favours surfaces that are parallel to the planes. `sweeps`: one or more families of
/// planes; each pixel gets the depth of the family in which its aggregated cost is least (Gallup et al.
/// 2007). Every pixel gets a depth, even a wrong one; see consistent_depth(). All pictures have the camera's
/// size. Long work, on all threads. Errors: usage for options out of range, no other frame, no planes, an
/// empty range, or planes that some lines of sight do not meet; interrupted.
Result<DepthMap> multi_view_depth(const PosedFrame& reference, std::span<const PosedFrame> others,
                                  const Pinhole& camera, std::span<const SweptPlanes> sweeps,
                                  const MultiViewOptions& options, const Work& work);

/// A depth map and the pose of its camera.
struct PosedDepthMap {
  DepthMap depth;
  CameraPose pose;
};

struct ConsistencyOptions {
  /// Depths agree if they differ by less than this share, 0.0005 … 0.1.
  double tolerance = 0.01;
  /// Least number of other maps that must agree on a pixel, 1 … 16.
  int least_agreeing = 2;
  /// The same where no other map has another depth, as at the borders of the pictures, which few maps show, 0
  /// … 16.
  int least_uncontested = 1;
  /// Greatest number of maps that see something farther through a pixel, for each that agrees, 0 … 16: an
  /// occluded strip beside a nearer surface continues it in neighbouring maps, and others see past it.
  double most_through = 1.0;
  /// Times that the maps are checked, 1 … 4: each pass with what the one before has kept, so that errors
  /// which agreed with each other are fewer.
  int passes = 2;
  /// Surfaces of fewer pixels than this share of the picture become unknown, 0 … 0.01: in plain surroundings
  /// a few pixels agree by chance. Neighbours belong to one surface if their depths agree.
  double least_patch = 0.0003;
};
std::vector<Parameter> parameters_of(ConsistencyOptions& options);

/// Keeps only the pixels on which enough other maps agree, with the mean of the agreeing depths, and which
/// are no small patches (Hirschmüller 2008, "peak filtering"), and through which not too many see something
/// farther; all others become unknown. Errors: usage for options out of range; interrupted.
Result<std::vector<PosedDepthMap>> consistent_depth(std::span<const PosedDepthMap> maps,
                                                    const ConsistencyOptions& options, const Work& work);

}  // namespace palpable::vision
