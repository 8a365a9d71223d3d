// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/structure/camera_motion.hpp"

#include <span>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// The frames from which the reconstruction is built, ascending: the first one, each frame in which the
/// points have moved by keyframe_step since the last keyframe or too few are left, and the last one. Where
/// fewer than keyframe_kept of a keyframe's points are in the next one, frames between them become keyframes
/// too.
std::vector<int> choose_keyframes(std::span<const PointTrack> tracks, int frame_count, int picture_width,
                                  const BatchMotionOptions& options);

}  // namespace palpable::vision
