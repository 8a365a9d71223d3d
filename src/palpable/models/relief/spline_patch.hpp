// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstddef>

namespace palpable::models {

/// A square part of a cubic spline surface z(x, y), as a Bezier patch: for searches that need bounds of its
/// distance. x to the right and y down, as a relief's samples.
class SplinePatch {
 public:
  /// The cell whose first corner is at `x_m`, `y_m` and whose sides are `side_m` long. `control`: the 4 x 4
  /// control values around it, row after row.
  SplinePatch(double x_m, double y_m, double side_m, const std::array<double, 16>& control) noexcept;

  /// A lower bound of the distance from `p` to the patch; its error falls with the square of the side.
  double least_distance_m(Vec3 p) const noexcept;
  /// One of its four quarters: bit 0 = right, bit 1 = lower.
  SplinePatch quarter(std::size_t which) const noexcept;

  double side_m() const noexcept { return side_m_; }
  double middle_x_m() const noexcept { return x_m_ + 0.5 * side_m_; }
  double middle_y_m() const noexcept { return y_m_ + 0.5 * side_m_; }

 private:
  SplinePatch() = default;

  double x_m_ = 0.0;
  double y_m_ = 0.0;
  double side_m_ = 0.0;
  /// Bezier ordinates, row after row.
  std::array<double, 16> z_m_{};
};

}  // namespace palpable::models
