// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// Parameters of plain_run_disparities().
struct PlainRunOptions {
  /// A run ends where a pixel differs from its mean by more than this; levels of 255, 1 … 64.
  int alike_levels = 10;
  /// The least length of a run; px, 2 … 1000.
  int least_px = 10;
  /// Lengths of one run in both pictures differ by at most this share and 1 px; 0 … 1.
  double length_share = 0.04;
  /// Matches in this many of the rows within two (itself included) agree with a match; 1 … 5.
  int agreeing_rows = 4;
};
std::vector<Parameter> parameters_of(PlainRunOptions& options);

/// The disparities of surfaces of one colour, which a window inside them cannot match and a window on their
/// outline, half of which shows what is behind, cannot either: runs of one grey level in a row that end
/// inside the picture are matched as a whole, by level and length. A run whose match is not the only one in
/// either direction is left out. Returns the number of pixels in such runs for the disparities 0 … width - 1.
/// Both pictures of the same size.
std::vector<int> plain_run_disparities(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                       const PlainRunOptions& options, const Work& work);

}  // namespace palpable::vision
