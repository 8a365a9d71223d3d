// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"

#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// Where three or more lines meet, in pixels of the picture (pixel centres at integers).
struct Junction {
  double x_px = 0.0;
  double y_px = 0.0;
  /// How many lines leave it.
  int branches = 0;
};

/// The junctions of one-pixel-wide lines (`line` > 0): places from which the lines themselves lead to three
/// or more different parts of the circle of `radius_px` (3 … 64) around. Gaps of two pixels, as thinning
/// leaves them at junctions, count as line; lines that only pass by do not. Those
/// so near to each other that their places hang together are one.
std::vector<Junction> find_junctions(const Raster<float>& line, int radius_px);

/// A label picture of `line`'s size: `label` in discs of `radius_px` round the junctions, 0 elsewhere.
Raster<std::uint8_t> mark_junctions(const std::vector<Junction>& junctions, int width, int height,
                                    double radius_px, std::uint8_t label);

}  // namespace palpable::sculpt
