// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/spline_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::models {
namespace {

/// Four of the sixteen numbers of a patch: `step` apart, from `first` on.
struct Line {
  std::size_t first, step;
  double& of(std::array<double, 16>& z, std::size_t k) const { return z[first + k * step]; }
};
Line row(std::size_t k) { return {4 * k, 1}; }
Line column(std::size_t k) { return {k, 4}; }

/// Control values of a uniform cubic B-spline become the Bezier ordinates between the middle two.
void to_bezier(std::array<double, 16>& z, Line line) {
  const double a = line.of(z, 0), b = line.of(z, 1), c = line.of(z, 2), d = line.of(z, 3);
  line.of(z, 0) = (a + 4.0 * b + c) / 6.0;
  line.of(z, 1) = (2.0 * b + c) / 3.0;
  line.of(z, 2) = (b + 2.0 * c) / 3.0;
  line.of(z, 3) = (b + 4.0 * c + d) / 6.0;
}

/// The ordinates of a cubic's first or second half (de Casteljau).
void halve(std::array<double, 16>& z, Line line, bool second) {
  const double a = line.of(z, 0), b = line.of(z, 1), c = line.of(z, 2), d = line.of(z, 3);
  const double ab = 0.5 * (a + b), bc = 0.5 * (b + c), cd = 0.5 * (c + d);
  const double abc = 0.5 * (ab + bc), bcd = 0.5 * (bc + cd), middle = 0.5 * (abc + bcd);
  const std::array<double, 4> half = second ? std::array{middle, bcd, cd, d} : std::array{a, ab, abc, middle};
  for (std::size_t k = 0; k < 4; ++k) line.of(z, k) = half[k];
}

/// The distance from `q` to the parallelogram z = b x + c y over 0 <= x, y <= side.
double to_parallelogram(Vec3 q, double b, double c, double side) {
  const auto squared = [&](double x, double y) { return squared_norm(q - Vec3{x, y, b * x + c * y}); };
  const double xx = 1.0 + b * b, yy = 1.0 + c * c, xy = b * c;
  const double at_x = q.x + b * q.z, at_y = q.y + c * q.z;
  const double determinant = xx * yy - xy * xy;
  const double x = (yy * at_x - xy * at_y) / determinant, y = (xx * at_y - xy * at_x) / determinant;
  const auto is_on = [side](double v) { return v >= 0.0 && v <= side; };
  if (is_on(x) && is_on(y)) return std::sqrt(squared(x, y));
  // Otherwise the nearest point is on a side.
  double least = std::numeric_limits<double>::infinity();
  for (const double on : {0.0, side}) {
    least = std::min(least, squared(on, std::clamp((at_y - xy * on) / yy, 0.0, side)));
    least = std::min(least, squared(std::clamp((at_x - xy * on) / xx, 0.0, side), on));
  }
  return std::sqrt(least);
}

}  // namespace

SplinePatch::SplinePatch(double x_m, double y_m, double side_m,
                         const std::array<double, 16>& control) noexcept
    : x_m_(x_m), y_m_(y_m), side_m_(side_m), z_m_(control) {
  for (std::size_t k = 0; k < 4; ++k) to_bezier(z_m_, row(k));
  for (std::size_t k = 0; k < 4; ++k) to_bezier(z_m_, column(k));
}

double SplinePatch::least_distance_m(Vec3 p) const noexcept {
  // Between two planes of the mean slope: their distance is of second order in the side.
  const double rise_x = 0.5 * ((z_m_[3] - z_m_[0]) + (z_m_[15] - z_m_[12]));
  const double rise_y = 0.5 * ((z_m_[12] - z_m_[0]) + (z_m_[15] - z_m_[3]));
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const double over =
          z_m_[4 * j + i] - (static_cast<double>(i) * rise_x + static_cast<double>(j) * rise_y) / 3.0;
      lowest = std::min(lowest, over);
      highest = std::max(highest, over);
    }
  const Vec3 from{p.x - x_m_, p.y - y_m_, p.z - 0.5 * (lowest + highest)};
  return to_parallelogram(from, rise_x / side_m_, rise_y / side_m_, side_m_) - 0.5 * (highest - lowest);
}

SplinePatch SplinePatch::quarter(std::size_t which) const noexcept {
  SplinePatch part = *this;
  const bool right = (which & 1U) != 0, lower = (which & 2U) != 0;
  part.side_m_ = 0.5 * side_m_;
  if (right) part.x_m_ += part.side_m_;
  if (lower) part.y_m_ += part.side_m_;
  for (std::size_t k = 0; k < 4; ++k) halve(part.z_m_, row(k), right);
  for (std::size_t k = 0; k < 4; ++k) halve(part.z_m_, column(k), lower);
  return part;
}

}  // namespace palpable::models
