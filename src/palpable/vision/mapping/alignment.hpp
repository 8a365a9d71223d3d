// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/mapping/surface_map.hpp"

#include <array>

namespace palpable::vision {

/// Errors of a pose, in the order turn about each axis of the world (rad), then position along each (m).
using PoseError = std::array<double, 6>;
/// A matrix of them, row-major and symmetric: their covariance, positive definite, or its inverse.
using PoseMatrix = std::array<double, 36>;

/// The covariance of independent errors with these standard deviations, > 0.
PoseMatrix independent_errors(Vec3 turn_rad, Vec3 position_m);

using WorldPose = Transform<WorldFrame, CameraFrame>;
/// `pose` after a turn about the camera and a shift, along the axes of the world; and its inverse.
WorldPose moved_by(const WorldPose& pose, const PoseError& motion);
PoseError motion_between(const WorldPose& from, const WorldPose& to);

/// The defaults were chosen on simulated rooms.
struct AlignmentOptions {
  /// Readings used, spread over the picture: 100 … 100 000.
  int readings = 3000;
  /// 1 … 100.
  int iterations = 12;
  /// The number of independent readings that as many are worth: neighbours have the map's errors in common.
  double independent_readings = 1500.0;
  /// Below this share of readings near the map's surface the picture is not aligned.
  double least_matched = 0.25;
};

struct AlignedPose {
  WorldPose world_from_camera;
  /// Share of the readings that lie near the map's surface.
  double matched = 0.0;
  /// Whether the pose was found; otherwise it is the expected one.
  bool found = false;
  /// What the picture says of the pose: the inverse of a covariance, 0 in the directions that it leaves open.
  PoseMatrix information{};
  /// How badly the readings lie on the map, where that is known: the mean of their squared distances from its
  /// surfaces over their noise, robust. About 0.5 where they lie well.
  double cost = 0.0;
};

/// The camera's pose at which a picture's points lie on the map's surfaces: Gauss-Newton on the map's
/// distances (Bylow et al. 2013), each weighted by its noise, robustly, together with the expected pose, that
/// of `frame`, which decides where the surfaces leave a direction open, as a bare wall does. Such directions
/// are told by the noise of the surfaces' normals, and are left to the expected pose wholly (Zhang, Kaess &
/// Singh 2016).
AlignedPose aligned(const SurfaceMap& map, const PosedDepth& frame, const PoseMatrix& expected,
                    const AlignmentOptions& options = {});

/// Another pose at which the picture lies much better on the map than at `found`, in the direction in which
/// `drift`, a covariance, is greatest: that of a camera that comes back to what it mapped before. nullopt:
/// there is none, or the drift is small.
std::optional<AlignedPose> relocated(const SurfaceMap& map, const PosedDepth& frame, const AlignedPose& found,
                                     const PoseMatrix& drift, const AlignmentOptions& options = {});

}  // namespace palpable::vision
