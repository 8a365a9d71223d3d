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

}  // namespace palpable::models
