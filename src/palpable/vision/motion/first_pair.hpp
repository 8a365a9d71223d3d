// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/motion/bundle.hpp"

#include <span>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// The two keyframes that a reconstruction begins with. The first one's camera is the world.
struct FirstPair {
  /// Indices into the keyframes.
  int first = 0, second = 0;
  BundlePose second_pose{};
  /// Points that both determine.
  int points = 0;
};

/// The pair of keyframes whose relative pose (Nistér's five points, in RANSAC) determines most points with
/// the angle that the options want. Errors: invalid_input, with what the camera did wrong; interrupted.
Result<FirstPair> choose_first_pair(std::span<const PointTrack> tracks, std::span<const int> keyframes,
                                    const Pinhole& camera, const BatchMotionOptions& options,
                                    const Work& work);

}  // namespace palpable::vision
