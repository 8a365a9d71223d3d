// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/image/census.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// One picture prepared for matching costs.
struct MatchView {
  ColourPlanes colour;
  /// census_9x7 of its luma.
  Raster<std::uint64_t> census;
  /// similar_pixels_9x7: which of the census' bits are compared.
  Raster<std::uint64_t> similar;
  /// The picture has content from this column on; a match before it is outside the picture.
  int first = 0;
};
MatchView match_view(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& luma,
                     const CensusOptions& census, const Work& work);

/// Cost of a match outside the picture, between the least (0) and the mean cost (1) of its pixel: a neutral
/// value.
inline constexpr float kOutOfViewCost = 0.6F;

/// The cost of a pixel pair: the census distance over pixels of similar colour (robust to exposure) plus the
/// truncated colour difference (sharp at edges), in 8 bits.
struct CostOptions {
  /// Weight of each of the 62 census bits that differ; 0 … 4.
  int census_weight = 2;
  /// Truncation of the greatest difference of the three channels; levels of 255, 1 … 255.
  int colour_limit = 20;
  /// Weight of each level of that difference; 0 … 8.
  int colour_weight = 2;
  /// How often the sum is halved; 0 … 4.
  int halvings = 0;
  /// Cost of a match outside the picture, between the pixel's least (0) and mean cost (1); 0 … 1.
  float out_of_view = kOutOfViewCost;
  CensusOptions census = {};
};
std::vector<Parameter> parameters_of(CostOptions& options);

/// Truncation of costs: high enough for all relevant costs, low enough for sums over windows in 16 bits.
inline constexpr int kLargestMatchingCost = 144;

/// A row of the other picture from right to left, so that the index increases with d; then `more` copies of
/// its first column.
struct ReversedRow {
  std::vector<std::uint64_t> census;
  std::vector<std::uint8_t> r, g, b;

  void assign(const MatchView& view, int y, int more);
};

/// Compares row y of `view` with the other picture's row at all disparities 0 … stride - 1. At [x * stride +
/// d], `census` is the census distance scaled to all bits, 0…63, and `colour` the greatest colour difference.
/// `there` has width + stride items. Vectorised.
void compare_row(const MatchView& view, int y, const ReversedRow& there, int stride, std::uint8_t* census,
                 std::uint8_t* colour);

/// The number of disparities rounded up to whole vectors.
inline int whole_vectors(int disparities) {
  constexpr int kLanes = 64;
  return (disparities + kLanes - 1) / kLanes * kLanes;
}

/// Costs of matching pixels of a pair, a scanline at a time. Any thread may call its const members.
class MatchingCost {
 public:
  MatchingCost(const MatchInput& input, const CostOptions& options, const Work& work);

  const ColourPlanes& left_colour() const { return left_.colour; }

  /// Fills out[x * stride + d] with the cost 0…kLargestMatchingCost of pixel (x, y) at disparity d, for d <
  /// stride; if x - d is outside the right picture, the cost is neutral. `out` has width * stride items.
  void fill_row(int y, int stride, std::uint8_t* out) const;

 private:
  CostOptions options_;
  MatchView left_;
  MatchView right_;
};

}  // namespace palpable::vision
