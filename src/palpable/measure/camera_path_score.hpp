// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"

#include <span>

namespace palpable::measure {

/// The world in which the true poses and the true surface are stated.
struct TrueWorldFrame;

/// Where a frame's camera was: found, in a world of any position, orientation and scale, or true.
struct FoundPose {
  int frame = 0;
  Transform<WorldFrame, CameraFrame> pose;
};
struct TruePose {
  int frame = 0;
  Transform<TrueWorldFrame, CameraFrame> pose;
};

struct CameraPathScore {
  /// The similarity that brings what was found to the truth: its rotation from the cameras' rotations, its
  /// scale and translation from their positions (least squares).
  Transform<TrueWorldFrame, WorldFrame> true_from_found;
  /// Frames that have both poses, and true ones without a found pose.
  int frames = 0;
  int missing_frames = 0;
  /// Length of the true path through the compared frames, in the truth's unit.
  double path_length = 0.0;
  /// RMS distance of positions after the alignment, percent of the path's length.
  double position_rms_percent = 0.0;
  double mean_rotation_deg = 0.0;
  double most_rotation_deg = 0.0;
};

/// Compares the camera path that was found in a video with the true one, frames matched by their numbers.
/// Rotations are orthonormal, scales of the poses one. Errors: invalid_input for fewer than three frames in
/// common, and where the cameras of one side stand in one place, so that nothing determines the scale.
Result<CameraPathScore> score_camera_path(std::span<const FoundPose> found, std::span<const TruePose> truth);

}  // namespace palpable::measure
