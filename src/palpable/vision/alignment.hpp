// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo.hpp"

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
  /// RMS of y_left - y_right of matched features, in pixels, before and after; NaN without features.
  double residual_before_px = 0.0;
  double residual_px = 0.0;
  int features = 0;
  /// False: the pair was aligned already and is given back as it came.
  bool changed = false;
  std::vector<std::string> notes;
};

/// Undistorts and rectifies a calibrated pair (Bouguet's method); the result carries its rig. Errors:
/// invalid_input for pictures of different sizes, or for cameras above rather than beside each other.
Result<AlignedPair> rectify_calibrated(const StereoPair& pair, const LensPair& cameras);

/// Aligns a pair of unknown cameras: features matched, outliers dropped by the fundamental matrix, and both
/// pictures turned (rotations and a focal length: little distortion; Fusiello & Irsara 2011) so that matches
/// share scanlines. A pair whose residual is at most 0.5 pixels is left alone. Too few features, or a rest
/// above 2 pixels: the pair is given back unchanged, with a note. Errors: invalid_input for sizes that
/// differ.
Result<AlignedPair> align_uncalibrated(const StereoPair& pair, const Work& work);

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

}  // namespace palpable::vision
