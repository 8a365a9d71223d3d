// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo_method.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// How the cost of a pixel pair is made: census distance over the pixels of like colour
/// (robust to exposure) and truncated absolute
/// difference of colour (sharp at edges), added in 8 bits.
struct CostOptions {
  /// Weight of each of the 62 census bits that differ.
  int census_weight = 2;
  /// Mean absolute colour difference, in levels of 255, is cut off here …
  int colour_limit = 15;
  /// … and weighted so.
  int colour_weight = 3;
};

/// Costs of matching pixels of a pair, a scanline at a time. Any thread may call its const members.
class MatchingCost {
 public:
  MatchingCost(const MatchInput& input, const CostOptions& options, const Work& work);

  /// Fills out[x * disparities + d] with the cost 0…255 of pixel (x, y) at disparity d; where x - d lies
  /// outside the right picture, its first column stands in. `out` has width * disparities items.
  void fill_row(int y, std::uint8_t* out) const;

 private:
  const MatchInput& input_;
  CostOptions options_;
  Raster<std::uint64_t> left_census_;
  Raster<std::uint64_t> left_alike_;
  Raster<std::uint64_t> right_census_;
};

}  // namespace palpable::vision
