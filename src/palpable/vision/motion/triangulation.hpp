// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/bundle.hpp"

#include <optional>
#include <span>

// Inside vision's sources only.
namespace palpable::vision {

/// A place and the pose of the camera that saw it there.
struct PosedSighting {
  BundlePose pose;
  ImagePoint place;
};

struct TriangulationOptions {
  /// The lines of sight must differ by this angle, degrees.
  double least_angle_deg = 1.5;
  /// Every error must be below it, px.
  double outlier_px = 2.0;
};

/// The point nearest to the lines of sight (sum of squared distances). None where it lies behind a camera,
/// the lines are nearly parallel, or an error is too large.
std::optional<std::array<double, 3>> triangulated_point(std::span<const PosedSighting> sightings,
                                                        const Pinhole& camera,
                                                        const TriangulationOptions& options);

}  // namespace palpable::vision
