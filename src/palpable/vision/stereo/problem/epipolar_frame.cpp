// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/epipolar_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpable::vision {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Disparities of one surface differ by less than this between neighbours, px.
constexpr float kSameSurface_px = 1.0F;

PicturePoint polar_place(const PolarAxes& axes, PicturePoint p) {
  const double x = p.x - axes.epipole.x, y = p.y - axes.epipole.y;
  const double radius = std::max(1e-6, std::hypot(x, y));
  double angle = std::fmod(std::atan2(y, x) - axes.first_angle, kTurn);
  if (angle < 0.0) angle += kTurn;
  const double column = axes.scale_px * std::log(radius / axes.first_radius_px);
  return {axes.forward ? -column : column, axes.scale_px * angle};
}

PicturePoint from_polar(const PolarAxes& axes, PicturePoint place) {
  const double column = axes.forward ? -place.x : place.x;
  const double radius = axes.first_radius_px * std::exp(column / axes.scale_px);
  const double angle = axes.first_angle + place.y / axes.scale_px;
  return {axes.epipole.x + radius * std::cos(angle), axes.epipole.y + radius * std::sin(angle)};
}

/// The depth along the frame's axis over that along the left picture's.
double depth_ratio(const EpipolarFrame& frame, PicturePoint left) {
  const Matrix3& h = frame.transform.left;
  return h[6] * left.x + h[7] * left.y + h[8];
}

float value_at(const Raster<float>& values, PicturePoint place, FrameValues kind) {
  const double x = std::clamp(place.x, 0.0, values.width() - 1.0),
               y = std::clamp(place.y, 0.0, values.height() - 1.0);
  const float nearest = values(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
  if (kind == FrameValues::confidence) return nearest;
  const int i = std::min(static_cast<int>(x), std::max(0, values.width() - 2)),
            j = std::min(static_cast<int>(y), std::max(0, values.height() - 2));
  const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
  const int right = std::min(i + 1, values.width() - 1), below = std::min(j + 1, values.height() - 1);
  const float a = values(i, j), b = values(right, j), c = values(i, below), d = values(right, below);
  const auto [least, most] = std::minmax({a, b, c, d});
  if (!(most - least < kSameSurface_px)) return nearest;
  return (1.0F - v) * ((1.0F - u) * a + u * b) + v * ((1.0F - u) * c + u * d);
}

}  // namespace

PicturePoint frame_from_picture(const EpipolarFrame& frame, const Matrix3& homography, PicturePoint point) {
  const PicturePoint p = rectified_point(frame.transform, homography, point);
  return frame.polar ? polar_place(*frame.polar, p) : p;
}

PicturePoint picture_from_frame(const EpipolarFrame& frame, const Matrix3& inverse_homography,
                                PicturePoint place) {
  if (frame.polar) place = from_polar(*frame.polar, place);
  return source_point(frame.transform, inverse_homography, place);
}

// A camera that moves by t along its axis sees a point at distance Z at Z / (Z - t) times the radius: with
// c = scale log(Z / (Z - t)), t / Z = 1 - exp(-c / scale). Backwards by t, the ratio is (Z + t) / Z.
double disparity_from_columns(const EpipolarFrame& frame, PicturePoint left, double columns) {
  if (!frame.polar) return depth_ratio(frame, left) * columns;
  const double scale = frame.polar->scale_px;
  return frame.polar->forward ? -scale * std::expm1(-columns / scale) : scale * std::expm1(columns / scale);
}

double columns_from_disparity(const EpipolarFrame& frame, PicturePoint left, double disparity_px) {
  if (!frame.polar) return disparity_px / depth_ratio(frame, left);
  const double scale = frame.polar->scale_px;
  return frame.polar->forward ? -scale * std::log1p(-std::min(disparity_px / scale, 1.0 - 1e-9))
                              : scale * std::log1p(std::max(disparity_px / scale, -1.0 + 1e-9));
}

PicturePoint right_point(const EpipolarFrame& frame, PicturePoint left, double disparity_px) {
  PicturePoint place = frame_from_picture(frame, frame.transform.left, left);
  place.x -= columns_from_disparity(frame, left, disparity_px);
  return picture_from_frame(frame, inverse(frame.transform.right), place);
}

Raster<float> in_left_picture(const EpipolarFrame& frame, const Raster<float>& values, FrameValues kind,
                              int width, int height) {
  if (values.empty()) return {};
  Raster<float> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const PicturePoint place = frame_from_picture(frame, frame.transform.left, {1.0 * x, 1.0 * y});
      const float value = value_at(values, place, kind);
      out(x, y) = kind == FrameValues::confidence
                      ? value
                      : static_cast<float>(
                            disparity_from_columns(frame, {1.0 * x, 1.0 * y}, static_cast<double>(value)));
    }
  return out;
}

}  // namespace palpable::vision
