// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace palpable::vision {

/// Row-major.
using Matrix3 = std::array<double, 9>;
inline constexpr Matrix3 kIdentity3{1, 0, 0, 0, 1, 0, 0, 0, 1};

/// A point in a picture, px; pixel centres at integers.
struct PicturePoint {
  double x = 0.0;
  double y = 0.0;
};

/// Maps both pictures to common rows.
struct RectifyingTransform {
  /// Homographies of pixels.
  Matrix3 left = kIdentity3;
  Matrix3 right = kIdentity3;
  /// Both lenses' distortion by the division model, about (cx, cy): u = p / (1 + distortion |p|²), 1/px².
  double distortion = 0.0;
  double cx = 0.0;
  double cy = 0.0;
};

/// Maps a point to the rectified picture, and back.
PicturePoint rectified_point(const RectifyingTransform& by, const Matrix3& homography, PicturePoint place);
PicturePoint source_point(const RectifyingTransform& by, const Matrix3& inverse_homography,
                          PicturePoint place);

/// The point that a homography maps `place` to.
PicturePoint mapped(const Matrix3& homography, PicturePoint place);

Matrix3 product(const Matrix3& a, const Matrix3& b);
Matrix3 inverse(const Matrix3& m);

}  // namespace palpable::vision
