// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/stereo/problem/rectifying_transform.hpp"

#include <optional>

namespace palpable::vision {

/// Polar axes about the epipole: a row is an epipolar line, a column a distance from the epipole in
/// logarithmic steps (Pollefeys, Koch & Van Gool 1999, with a logarithmic radius), so that a disparity is a
/// depth, whatever its place in the picture.
struct PolarAxes {
  /// The epipole, px of the transformed pictures.
  PicturePoint epipole;
  /// Rows per radian, and columns per unit of the radius' logarithm; px.
  double scale_px = 1.0;
  /// The angle of row 0, radians.
  double first_angle = 0.0;
  /// The radius of column 0, px.
  double first_radius_px = 1.0;
  /// The camera moved forward, so points move away from the epipole: the radius falls with the column.
  bool forward = true;
};

/// The frame in which the pictures of a camera that moved in any direction lie on common rows, with
/// disparities of at least 0: both pictures are transformed and, where the camera moved towards what it sees,
/// polar. Of a frame that is not polar, the left homography is K' R K⁻¹, not scaled: its third row gives the
/// depth along the frame's axis over that along the picture's.
struct EpipolarFrame {
  /// Size of the pictures in the frame.
  int width = 0;
  int height = 0;
  RectifyingTransform transform;
  std::optional<PolarAxes> polar;
};

/// The place in the frame of a point of the left picture; and with the transform's right homography.
PicturePoint frame_from_picture(const EpipolarFrame& frame, const Matrix3& homography, PicturePoint point);
/// Back; `inverse_homography` is the inverse of the transform's left or right one.
PicturePoint picture_from_frame(const EpipolarFrame& frame, const Matrix3& inverse_homography,
                                PicturePoint place);

/// The disparity of a point of the left picture, proportional to its inverse depth along that picture's axis,
/// from the distance of columns in the frame; and back.
double disparity_from_columns(const EpipolarFrame& frame, PicturePoint left, double columns);
double columns_from_disparity(const EpipolarFrame& frame, PicturePoint left, double disparity_px);

/// Where the right picture shows the left picture's point that has this disparity.
PicturePoint right_point(const EpipolarFrame& frame, PicturePoint left, double disparity_px);

enum class FrameValues { disparity, confidence };

/// Values of the frame, of its columns' distances or of confidence, at the pixels of a left picture of this
/// size: disparities become proportional to inverse depth; they are interpolated on one surface only.
Raster<float> in_left_picture(const EpipolarFrame& frame, const Raster<float>& values, FrameValues kind,
                              int width, int height);

}  // namespace palpable::vision
