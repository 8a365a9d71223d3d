// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/rectification/lens_camera.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <vector>

namespace palpable::vision {

struct ChessboardOptions {
  /// Inner corners along the board's sides, 2 … 100 each.
  int columns = 9;
  int rows = 6;
  /// Side of a square, m. 0.0001 … 10.
  double square_m = 0.025;
  /// Half the window in which a corner is refined to a fraction of a pixel, px. 1 … 50.
  int corner_window_px = 5;
  /// Pictures that must show the whole board. 3 … 1000.
  int least_boards = 3;
};
std::vector<Parameter> parameters_of(ChessboardOptions& options);

struct ChessboardCalibration {
  LensPair cameras;
  /// RMS reprojection error of the corners in pixels, over both cameras.
  double reprojection_px = 0.0;
  /// Pairs in which both pictures show the whole board.
  int pairs_used = 0;
};

/// Calibrates a stereo camera from pictures of a chessboard (Zhang 2000, by OpenCV). Errors: usage for
/// options out of range; invalid_input if too few pairs show the whole board or the sizes differ;
/// interrupted.
Result<ChessboardCalibration> calibrate_from_chessboards(const std::vector<StereoPair>& pairs,
                                                         const ChessboardOptions& options, const Work& work);

struct CameraCalibration {
  LensCamera camera;
  /// RMS reprojection error in pixels.
  double reprojection_px = 0.0;
  int pictures_used = 0;
};

/// Calibrates one camera from pictures of a chessboard. Errors: as calibrate_from_chessboards().
Result<CameraCalibration> calibrate_camera(const std::vector<Image>& pictures,
                                           const ChessboardOptions& options, const Work& work);

}  // namespace palpable::vision
