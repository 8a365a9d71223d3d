// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace palpable::models {

// The weights of the leaves under a distance field's moving window (field_window.hpp).

/// Which sides of a window's corner a leaf covers along x, y and z.
struct WindowSides {
  /// Below it (1), above it (2), both (3).
  std::array<std::uint8_t, 3> along;
  /// 1 if it covers the side below the corner, else 0.
  int below(std::size_t axis) const noexcept { return along[axis] & 1; }
};

/// For each set of octants (FieldWindow::octants) the sides that it covers. A table takes a third of the
/// instructions.
inline constexpr auto kWindowSides = [] {
  constexpr std::array kBelow{0x55U, 0x33U, 0x0FU};
  std::array<WindowSides, 256> all{};
  for (unsigned octants = 0; octants < all.size(); ++octants)
    for (std::size_t axis = 0; axis < kBelow.size(); ++axis) {
      const bool below = (octants & kBelow[axis]) != 0, above = (octants & ~kBelow[axis]) != 0;
      all[octants].along[axis] = static_cast<std::uint8_t>((below ? 1 : 0) + (above ? 2 : 0));
    }
  return all;
}();

/// The share of the window on each of WindowSides along one axis, and its derivative per cell.
struct WindowShares {
  std::array<double, 4> share{0.0, 0.0, 0.0, 1.0};
  std::array<double, 4> slope{};

  explicit WindowShares(double place_over_corner) noexcept {
    const double t = 2.0 * place_over_corner;
    const double rest = 1.0 - std::abs(t);
    const double half = 0.5 * rest * rest;
    // Chosen by number: the sign cannot be predicted.
    const std::array<double, 2> upper{1.0 - half, half};
    share[2] = upper[t < 0.0 ? 1 : 0];
    share[1] = 1.0 - share[2];
    slope[2] = 2.0 * rest;
    slope[1] = -slope[2];
  }
};

/// The share of the window in a leaf, and its derivative per cell. A leaf is a box: its share is the product
/// of those along the axes.
struct WindowWeight {
  double share;
  Vec3 along;
};
inline WindowWeight weight_of(const WindowSides& sides, const std::array<WindowShares, 3>& shares) noexcept {
  const std::size_t x = sides.along[0], y = sides.along[1], z = sides.along[2];
  const double x_share = shares[0].share[x], y_share = shares[1].share[y], z_share = shares[2].share[z];
  const double xy = x_share * y_share;
  return {xy * z_share,
          {shares[0].slope[x] * y_share * z_share, x_share * shares[1].slope[y] * z_share,
           xy * shares[2].slope[z]}};
}

}  // namespace palpable::models
