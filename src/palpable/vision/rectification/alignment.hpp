// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <array>
#include <string>
#include <vector>

namespace palpable::vision {

/// A camera with its lens: row-major 3 x 3 matrix in pixels, distortion in OpenCV's order (0, 4, 5, 8, 12 or
/// 14).
struct LensCamera {
  std::array<double, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::vector<double> distortion;
};

/// A camera without distortion whose picture of this width spans 65 degrees, as a phone's does: what is
/// assumed of a camera that nothing is known of.
LensCamera usual_camera(int width, int height);

/// Two calibrated cameras: p_right = rotation * p_left + translation_m (row-major, metres).
struct LensPair {
  LensCamera left;
  LensCamera right;
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 translation_m;
};

/// A pair brought to common scanlines.
struct AlignedPair {
  StereoPair pair;
  /// RMS of y_left - y_right of matched features, in pixels, before and after; NaN without features, and
  /// before a rectification of distorted pictures.
  double residual_before_px = 0.0;
  double residual_px = 0.0;
  /// Matches that agree, features and tracked corners.
  int features = 0;
  /// False: the pair was aligned already and is given back as it came.
  bool changed = false;
  std::vector<std::string> notes;
};

/// Undistorts and rectifies a calibrated pair (Bouguet's method); the result carries its rig. Errors:
/// invalid_input for pictures of different sizes, and for cameras of which the right one does not stand
/// mainly to the right.
Result<AlignedPair> rectify_calibrated(const StereoPair& pair, const LensPair& cameras);

/// Aligns a pair of unknown cameras: features matched, corners tracked once these have made the pair about
/// straight, and both pictures turned (rotations and a focal length: little distortion; Fusiello & Irsara
/// 2011) so that matches share scanlines, the left one, which is the reference, as little as possible. Where
/// no turn explains the matches but a rolling offset of the right picture's rows does, these are moved
/// instead and the left picture stays. A pair whose residual is at most 0.5 pixels is left alone. Too few
/// features, or a rest above 2 pixels: the pair is given back unchanged, with a note. Errors: invalid_input
/// for sizes that differ; interrupted.
Result<AlignedPair> align_uncalibrated(const StereoPair& pair, const Work& work);

/// One camera that took the left picture, then, moved sideways by `moved_m` metres and turned a little by
/// accident, the right one. Both are freed of the lens's distortion and turned as the matched features
/// demand; the result carries a rig whose baseline is `moved_m`: depth in metres. Where the features stay
/// where turning alone would put them, the camera hardly moved, and a note says so with the figure. Errors:
/// as align_uncalibrated().
Result<AlignedPair> align_moved(const StereoPair& pair, const LensCamera& camera, double moved_m,
                                const Work& work);

/// The pair as two cameras without distortion would have seen it; each keeps its matrix. Errors:
/// invalid_input for sizes that differ.
Result<StereoPair> undistorted(const StereoPair& pair, const LensCamera& left, const LensCamera& right);

struct ChessboardOptions {
  /// Inner corners along the board's sides, and the side of a square.
  int columns = 9;
  int rows = 6;
  double square_m = 0.025;
};

struct ChessboardCalibration {
  LensPair cameras;
  /// RMS distance of the corners from where the calibration puts them, in pixels, over both cameras.
  double reprojection_px = 0.0;
  /// Pairs in which both boards were found.
  int pairs_used = 0;
};

/// Calibrates a stereo camera from pictures of a chessboard. Errors: invalid_input where fewer than three
/// pairs show the whole board or the sizes differ; interrupted.
Result<ChessboardCalibration> calibrate_from_chessboards(const std::vector<StereoPair>& pairs,
                                                         const ChessboardOptions& options, const Work& work);

struct CameraCalibration {
  LensCamera camera;
  double reprojection_px = 0.0;
  int pictures_used = 0;
};

/// Calibrates one camera from pictures of a chessboard. Errors: as calibrate_from_chessboards().
Result<CameraCalibration> calibrate_camera(const std::vector<Image>& pictures,
                                           const ChessboardOptions& options, const Work& work);

}  // namespace palpable::vision
