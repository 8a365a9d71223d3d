// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/sculpt/triangles/four_boxes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// The leaves of a TriangleTree that may hold the nearest triangle of places in a ball, those nearest to its
/// centre first. Of a tree that has more there than fit, none, and is_whole is set.
struct TriangleShortlist {
  struct Four {
    FourBoxes boxes;
    std::array<std::uint32_t, FourBoxes::kCount> node;
    /// They and all after them are at least this far from the centre.
    double from_m = 0.0;
  };
  static constexpr std::size_t kMost = 256;

  Vec3 centre_m;
  std::vector<Four> fours;
  bool is_whole = false;
  /// How often a ball in this one was entered for which it serves as well.
  std::size_t entered_again = 0;
};

}  // namespace palpable::sculpt
