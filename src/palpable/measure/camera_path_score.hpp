// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"

#include <span>

namespace palpable::measure {

/// The world frame of the true poses and the true surface.
struct TrueWorldFrame;

/// The camera pose of a frame: estimated, in a world frame of arbitrary position, orientation and scale, or
/// true.
struct FoundPose {
  int frame = 0;
  Transform<WorldFrame, CameraFrame> pose;
};
struct TruePose {
  int frame = 0;
  Transform<TrueWorldFrame, CameraFrame> pose;
};

struct CameraPathScore {
  /// The similarity transform from the estimate to the truth: its rotation from the cameras' rotations, its
  /// scale and translation from their positions (least squares).
  Transform<TrueWorldFrame, WorldFrame> true_from_found;
  /// Number of frames with both poses, and of true ones without an estimate.
  int frames = 0;
  int missing_frames = 0;
  /// Length of the true path through the compared frames, in the unit of the truth.
  double path_length = 0.0;
  /// RMS distance of the positions after alignment, percent of the path's length.
  double position_rms_percent = 0.0;
  double mean_rotation_deg = 0.0;
  double most_rotation_deg = 0.0;
};

/// Compares the camera path estimated from a video with the true one; frames are matched by number. Rotations
/// must be orthonormal, scales of the poses 1. Errors: invalid_input for fewer than three common frames, and
/// if the cameras of one path are all at one position, so that the scale is undetermined.
Result<CameraPathScore> score_camera_path(std::span<const FoundPose> found, std::span<const TruePose> truth);

}  // namespace palpable::measure
