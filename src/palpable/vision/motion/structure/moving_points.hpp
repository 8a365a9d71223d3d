// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/motion/structure/camera_motion.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

struct MovingPointOptions {
  /// A point is judged if so many frames with a pose show it, 3 … 100.
  int least_frames = 6;
  /// It moves by itself if half of its places are farther than this from those of the best point that stays
  /// in its place, px, 0.5 … 50. Well above the errors of points that slide along an edge.
  double least_error_px = 4.0;
};
std::vector<Parameter> parameters_of(MovingPointOptions& options);

/// Points of a video that were judged, and those of them that move by themselves: a hand, a person, or
/// what moves with the camera.
struct MovingPoints {
  int judged = 0, moving = 0;

  double share() const { return judged > 0 ? static_cast<double>(moving) / judged : 0.0; }
};

/// Compares each track with the best point that stays in its place. Points that are seen under too small
/// angles are not judged, since far points explain any of them. Any thread.
MovingPoints moving_points(std::span<const PointTrack> tracks, const CameraMotion& motion,
                           const MovingPointOptions& options);

}  // namespace palpable::vision
