// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace palpable::models {

// The moving window of a distance field's query (distance_field.hpp): a product of tent functions that reach
// half a finest cell to each side. Along each axis it crosses at most one face between finest cells. So it
// consists of eight octants around a corner of these cells, and its leaves are the same for all places that
// have the same nearest corner.

/// The leaves under a window, as the last query left them: the next one with the same nearest corner need not
/// search them. It changes no result. All zero, or default-initialised = nothing is known.
struct FieldWindow {
  /// In finest cells.
  std::array<std::int32_t, 3> corner;
  /// Leaves, in the order of their first octants.
  std::uint8_t count;
  /// Of these, the ones that are not the same planes as an earlier one.
  std::uint8_t different;
  /// Whether the corner is inside the grid, so that every place near it is too.
  bool is_inner = false;
  /// For each leaf: the index of its words.
  std::array<std::uint32_t, 8> words;
  /// The octants that it covers, one bit each (x in bit 0 of the bit's number, y in bit 1, z in bit 2).
  std::array<std::uint8_t, 8> octants;
  /// Its side is 2^level finest cells.
  std::array<std::uint8_t, 8> level;
  /// The first leaf with the same planes; its own number if there is none.
  std::array<std::uint8_t, 8> same;

  /// Whether it is that of a place, in finest cells.
  bool is_of(Vec3 cells) const noexcept {
    // The greatest of the three: whether each is near cannot be predicted.
    const double off = std::max(
        {std::abs(cells.x - corner[0]), std::abs(cells.y - corner[1]), std::abs(cells.z - corner[2])});
    return is_inner && off < 0.5;
  }
};

/// Which sides of a window's corner a leaf covers along an axis: below it (1), above it (2), both (3).
inline unsigned sides_of(unsigned octants, std::size_t axis) noexcept {
  constexpr std::array kBelow{0x55U, 0x33U, 0x0FU};
  return ((octants & kBelow[axis]) != 0 ? 1U : 0U) | ((octants & ~kBelow[axis]) != 0 ? 2U : 0U);
}

/// The share of the window on each of sides_of() along one axis, and its derivative per cell.
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
inline WindowWeight weight_of(unsigned octants, const std::array<WindowShares, 3>& shares) noexcept {
  const std::size_t x = sides_of(octants, 0), y = sides_of(octants, 1), z = sides_of(octants, 2);
  const double x_share = shares[0].share[x], y_share = shares[1].share[y], z_share = shares[2].share[z];
  const double xy = x_share * y_share;
  return {xy * z_share,
          {shares[0].slope[x] * y_share * z_share, x_share * shares[1].slope[y] * z_share,
           xy * shares[2].slope[z]}};
}

}  // namespace palpable::models
