// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/rectification/lens_camera.hpp"
#include "palpable/vision/rectification/stereo_rectification_options.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <string>
#include <vector>

namespace palpable::vision {

/// A pair whose corresponding points lie on common rows.
struct RectifiedPair {
  StereoPair pair;
  /// RMS of y_left - y_right of matched features, in pixels, before and after; NaN without features, and
  /// before a rectification of distorted pictures.
  double residual_before_px = 0.0;
  double residual_px = 0.0;
  /// Number of inlier matches: features and tracked corners.
  int features = 0;
  /// False: the pair was rectified already and is returned as it came.
  bool changed = false;
  std::vector<std::string> notes;
};

/// Undistorts and rectifies a calibrated pair (Bouguet's method); the result carries its rig. Errors:
/// invalid_input for pictures of different sizes, and if the right camera is not mainly to the right of the
/// left one; usage for options out of range.
Result<RectifiedPair> rectify_calibrated(const StereoPair& pair, const LensPair& cameras,
                                         const StereoRectificationOptions& options = {});

/// Rectifies a pair of unknown cameras. Features are matched; after a first rectification by them, corners
/// are tracked. Both pictures are warped by rotations and a focal length (little distortion; Fusiello &
/// Irsara 2011), the left one, which is the reference, as little as possible. If no rotation explains the
/// matches but a smooth vertical offset of the right picture's rows does (a rolling shutter), these rows are
/// moved and the left picture does not change. A pair that is rectified already is not changed. With too few
/// features or too large a residual, the pair is returned unchanged with a note. Errors: invalid_input for
/// sizes that differ; usage for options out of range; interrupted.
Result<RectifiedPair> rectify_uncalibrated(const StereoPair& pair, const Work& work,
                                           const StereoRectificationOptions& options = {});

/// Two pictures from one camera, which moved by `moved_m` metres, mainly sideways, from the left picture to
/// the right one and may have turned. Both are undistorted, and the matched features give the frame of the
/// movement; the result's rig gives depth in metres along the left picture's axis. If a rotation alone
/// explains the features, the camera hardly moved: the pictures are rotated onto common rows, and a note
/// reports it with the figure. Errors: as rectify_uncalibrated().
Result<RectifiedPair> rectify_moved_camera(const StereoPair& pair, const LensCamera& camera, double moved_m,
                                           const Work& work, const StereoRectificationOptions& options = {});

/// The pair without lens distortion; each camera keeps its matrix. Errors: invalid_input for sizes that
/// differ.
Result<StereoPair> undistorted(const StereoPair& pair, const LensCamera& left, const LensCamera& right);

}  // namespace palpable::vision
