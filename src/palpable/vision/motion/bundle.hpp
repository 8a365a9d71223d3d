// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/vision/motion/camera_motion.hpp"

#include <array>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// A rotation (angle-axis) and a translation, camera from world: p_camera = R p_world + t.
using BundlePose = std::array<double, 6>;

BundlePose bundle_pose(const CameraPose& world_from_camera);
CameraPose camera_pose(const BundlePose& pose);

/// Where a point is seen.
struct Sighting {
  int pose = 0;
  int point = 0;
  ImagePoint place;
};

/// Poses, points and where they are seen.
struct Bundle {
  std::vector<BundlePose> poses;
  std::vector<std::array<double, 3>> points;
  std::vector<Sighting> sightings;
  /// Both focal lengths are multiplied by it.
  double focal_scale = 1.0;
};

struct BundleOptions {
  /// Errors above it count linearly (Huber), px.
  double robust_px = 0.7;
  int most_iterations = 30;
  /// Whether the focal length is refined too.
  bool refine_focal_length = false;
};

/// The distance between the seen and the projected place, px; infinite behind the camera.
double projection_error_px(const Pinhole& camera, const BundlePose& pose, const std::array<double, 3>& point,
                           ImagePoint seen);

/// Moves poses and points to the least sum of robust squared errors (Ceres, sparse Schur complement). The
/// first pose stays. Polls cancel between iterations and returns early then.
void adjust_bundle(Bundle& bundle, const Pinhole& camera, const BundleOptions& options, const Work& work);

}  // namespace palpable::vision
