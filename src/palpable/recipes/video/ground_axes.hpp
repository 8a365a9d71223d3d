// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/vision/motion/structure/camera_motion.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::recipes {

struct GroundAxesOptions {
  /// Random triples of points that are tried as the ground's plane, 10 … 100 000.
  int trials = 400;
  /// A point lies on a plane within this distance, as a share of the points' median distance from their
  /// mean, 0.001 … 0.2.
  double tolerance = 0.015;
  /// Points that the planes are compared with, 100 … 1 000 000.
  int sampled_points = 5000;
};
std::vector<Parameter> parameters_of(GroundAxesOptions& options);

/// Axes of a model that a video shows: z is the normal of the ground on which it stands, towards the cameras;
/// y lies in the ground, away from them.
struct GroundAxes {
  /// Rotation axes_from_world, row-major.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  /// Added after the rotation; ground_axes() leaves it zero.
  Vec3 translation;

  Transform<SceneFrame, WorldFrame> axes_from_world() const;
};

/// Estimates the axes from the structure. The ground's direction is that of the plane on which most points
/// lie (RANSAC); only the direction of parallel planes matters. `structure` and `poses` must not be empty.
/// Deterministic for a seed. The options must be in their ranges (check_ranges()).
GroundAxes ground_axes(const PointCloud& structure, std::span<const vision::CameraPose> poses,
                       const GroundAxesOptions& options, std::uint64_t seed);

/// The normal of the ground from the points of a reconstruction, in its world, towards the cameras; zero if
/// there are none.
Vec3 ground_normal(const vision::CameraMotion& motion, const GroundAxesOptions& options, std::uint64_t seed);

}  // namespace palpable::recipes
