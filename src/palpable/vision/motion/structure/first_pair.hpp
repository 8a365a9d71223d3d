// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/motion/structure/bundle.hpp"

#include <span>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// The two keyframes with which a reconstruction starts. The world frame is the first one's camera.
struct FirstPair {
  /// Indices into the keyframes.
  int first = 0, second = 0;
  BundlePose second_pose{};
  /// Number of points that both determine.
  int points = 0;
};

/// Chooses the pair of keyframes whose relative pose (Nistér's five-point method with RANSAC) determines most
/// points with the required triangulation angle. Errors: invalid_input, with the deficiency of the camera's
/// motion; interrupted.
Result<FirstPair> choose_first_pair(std::span<const PointTrack> tracks, std::span<const int> keyframes,
                                    const Pinhole& camera, const BatchMotionOptions& options,
                                    const Work& work);

}  // namespace palpable::vision
