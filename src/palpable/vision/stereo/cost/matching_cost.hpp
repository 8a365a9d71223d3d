// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/image/census.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// One picture as costs compare it.
struct MatchView {
  ColourPlanes colour;
  /// census_9x7 of its luma.
  Raster<std::uint64_t> census;
  /// similar_pixels_9x7: which of the census' bits are compared.
  Raster<std::uint64_t> similar;
  /// The picture shows something from this column on; what would match before it is out of view.
  int first = 0;
};
MatchView match_view(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& luma,
                     const CensusOptions& census, const Work& work);

/// The cost of a match that lies out of view, between the least (0) and the mean cost (1) of its pixel: it
/// neither attracts nor repels.
inline constexpr float kOutOfViewCost = 0.6F;

/// How the cost of a pixel pair is made: census distance over the pixels of similar colour (robust to
/// exposure) and truncated difference of colour (sharp at edges), added in 8 bits.
struct CostOptions {
  /// Weight of each of the 62 census bits that differ; 0 … 4.
  int census_weight = 2;
  /// The greatest difference of the three channels is cut off here; levels of 255, 1 … 255.
  int colour_limit = 20;
  /// Weight of each level of that difference; 0 … 8.
  int colour_weight = 2;
  /// How often the sum is halved; 0 … 4.
  int halvings = 0;
  /// Share of the way from the pixel's least (0) to its mean cost (1) that a match out of view costs; 0 … 1.
  float out_of_view = kOutOfViewCost;
  CensusOptions census = {};
};
std::vector<Parameter> parameters_of(CostOptions& options);

/// Costs are cut off here: high enough for any that matters, low enough for sums over windows in 16 bits.
inline constexpr int kLargestMatchingCost = 144;

/// A row of the other picture from right to left, so that x - d runs forward with d; then `more` copies of
/// its first column.
struct ReversedRow {
  std::vector<std::uint64_t> census;
  std::vector<std::uint8_t> r, g, b;

  void assign(const MatchView& view, int y, int more);
};

/// How row y of `view` differs from the other picture's, at all disparities 0 … stride - 1: out[x * stride +
/// d] is the census distance as if over all its bits, 0…63, and the greatest colour difference.
/// `there` has width + stride items. Runs in vectors.
void compare_row(const MatchView& view, int y, const ReversedRow& there, int stride, std::uint8_t* census,
                 std::uint8_t* colour);

/// So many disparities, rounded up to whole vectors.
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
  /// stride; where x - d lies before what the right picture shows, one that neither attracts nor repels.
  /// `out` has width * stride items.
  void fill_row(int y, int stride, std::uint8_t* out) const;

 private:
  CostOptions options_;
  MatchView left_;
  MatchView right_;
};

}  // namespace palpable::vision
