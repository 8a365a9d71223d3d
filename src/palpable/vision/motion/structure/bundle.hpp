// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/vision/motion/structure/camera_motion.hpp"
#include "palpable/vision/motion/tracks/rolling_shutter.hpp"

#include <array>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// A rotation (angle-axis) and a translation, camera_from_world: p_camera = R p_world + t.
using BundlePose = std::array<double, 6>;

BundlePose bundle_pose(const CameraPose& world_from_camera);
CameraPose camera_pose(const BundlePose& pose);

/// An observation of a point in a frame.
struct Observation {
  int pose = 0;
  int point = 0;
  ImagePoint place;
  /// Only for an unknown readout.
  PlaceMotion motion = {};
};

/// The variables of a bundle adjustment: poses, points and observations.
struct Bundle {
  std::vector<BundlePose> poses;
  std::vector<std::array<double, 3>> points;
  std::vector<Observation> observations;
  /// Factor of both focal lengths.
  double focal_scale = 1.0;
  Readout readout = {};
};

struct BundleOptions {
  /// Scale of the Huber loss, px: larger errors count linearly.
  double robust_px = 0.7;
  int most_iterations = 30;
  /// Whether the focal length is refined too.
  bool refine_focal_length = false;
  /// Whether the readout is refined too. If not, it is zero.
  bool refine_readout = false;
};

/// Half the sum of the robust squared errors, px^2.
struct BundleCosts {
  double before = 0.0, after = 0.0;
};

/// Reprojection error: the distance between the observed and the projected position, px; infinite behind the
/// camera.
double projection_error_px(const Pinhole& camera, const BundlePose& pose, const std::array<double, 3>& point,
                           ImagePoint seen);

/// Minimises the sum of robust squared reprojection errors over poses and points (Ceres, sparse Schur
/// complement). The first pose is fixed, and the scale by one coordinate of the farthest other one. Polls
/// cancel between iterations and returns early then.
BundleCosts adjust_bundle(Bundle& bundle, const Pinhole& camera, const BundleOptions& options,
                          const Work& work);

}  // namespace palpable::vision
