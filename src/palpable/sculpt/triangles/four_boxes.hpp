// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <bit>
#include <cstddef>

namespace palpable::sculpt {

/// A box along three directions at right angles to each other.
struct OrientedBox {
  std::array<Vec3, 3> axes;
  /// How far it reaches along each.
  std::array<double, 3> low, high;
};

/// Four such boxes in single precision, relative to an origin near them, whose distances are computed at
/// once. A box is enlarged by `slack`, which covers the rounding, so a distance is never too large. An unset
/// box is far away.
class FourBoxes {
 public:
  static constexpr std::size_t kCount = 4;
  using Distances = std::array<float, kCount>;

  void set(std::size_t lane, const OrientedBox& box, double slack) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      x_[axis][lane] = static_cast<float>(box.axes[axis].x);
      y_[axis][lane] = static_cast<float>(box.axes[axis].y);
      z_[axis][lane] = static_cast<float>(box.axes[axis].z);
      low_[axis][lane] = static_cast<float>(box.low[axis] - slack);
      high_[axis][lane] = static_cast<float>(box.high[axis] + slack);
    }
  }
  /// Copies a box from another group.
  void set(std::size_t lane, const FourBoxes& from, std::size_t lane_there) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      x_[axis][lane] = from.x_[axis][lane_there];
      y_[axis][lane] = from.y_[axis][lane_there];
      z_[axis][lane] = from.z_[axis][lane_there];
      low_[axis][lane] = from.low_[axis][lane_there];
      high_[axis][lane] = from.high_[axis][lane_there];
    }
  }

  /// A lower bound of the squared distance to the content of each box.
  Distances squared_distances(const std::array<float, 3>& p) const {
    Four sum{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Four along = x_[axis] * p[0] + y_[axis] * p[1] + z_[axis] * p[2];
      const Four out = larger(larger(low_[axis] - along, along - high_[axis]), Four{});
      sum += out * out;
    }
    return std::bit_cast<Distances>(sum);
  }
  /// An upper bound of the squared distance to any point of each box.
  Distances squared_reaches(const std::array<float, 3>& p) const {
    Four sum{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Four along = x_[axis] * p[0] + y_[axis] * p[1] + z_[axis] * p[2];
      const Four out = larger(along - low_[axis], high_[axis] - along);
      sum += out * out;
    }
    return std::bit_cast<Distances>(sum);
  }

 private:
  /// Of GCC and Clang: one register, every operation on all four.
  using Four = float __attribute__((vector_size(kCount * sizeof(float))));
  using Axes = std::array<Four, 3>;
  static constexpr float kFar = 1e15F;
  static Four larger(Four a, Four b) { return a < b ? b : a; }
  static Four same(float v) { return Four{v, v, v, v}; }

  Axes x_{}, y_{}, z_{};
  Axes low_{same(kFar), same(kFar), same(kFar)};
  Axes high_{same(kFar), same(kFar), same(kFar)};
};

}  // namespace palpable::sculpt
