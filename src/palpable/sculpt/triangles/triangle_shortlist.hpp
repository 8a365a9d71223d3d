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

/// The leaves of a TriangleTree that may contain the nearest triangle of any point in a ball, those nearest
/// to its centre first. If there are more than fit, the list is empty and is_whole is set.
struct TriangleShortlist {
  struct Four {
    FourBoxes boxes;
    std::array<std::uint32_t, FourBoxes::kCount> node;
    /// Least distance of these and all later leaves from the centre.
    double from_m = 0.0;
  };
  static constexpr std::size_t kMost = 256;

  Vec3 centre_m;
  std::vector<Four> fours;
  bool is_whole = false;
  /// How often the list was reused for a smaller ball inside this one.
  std::size_t entered_again = 0;
};

}  // namespace palpable::sculpt
