// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/structure/bundle.hpp"

#include <optional>
#include <span>

// Inside vision's sources only.
namespace palpable::vision {

/// An observation of a point and the pose of its camera.
struct PosedObservation {
  BundlePose pose;
  ImagePoint place;
};

struct TriangulationOptions {
  /// Least angle between two viewing rays, degrees.
  double least_angle_deg = 1.5;
  /// Greatest reprojection error, px.
  double outlier_px = 2.0;
};

/// The point with the least sum of squared distances to the viewing rays. nullopt if it is behind a camera,
/// the rays are nearly parallel, or an error is too large.
std::optional<std::array<double, 3>> triangulated_point(std::span<const PosedObservation> observations,
                                                        const Pinhole& camera,
                                                        const TriangulationOptions& options);

}  // namespace palpable::vision
