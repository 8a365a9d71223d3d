// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/cross_window.hpp"
#include "palpable/vision/stereo/cost/matching_cost.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A matching cost for each pixel and disparity. The disparities of a pixel are contiguous and padded to
/// whole vectors. Costs are in units of 1/kCostUnit.
struct CostVolume {
  int width = 0;
  int height = 0;
  int disparities = 0;
  /// Values per pixel, a multiple of 32; those from `disparities` on are undefined.
  int stride = 0;
  std::vector<std::uint16_t> cost;

  CostVolume() = default;
  CostVolume(int width_, int height_, int disparities_);
  std::uint16_t* at(int x, int y) { return cost.data() + offset(x, y); }
  const std::uint16_t* at(int x, int y) const { return cost.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(stride);
  }
};

inline constexpr int kCostUnit = 2048;

/// Parameters of a cost volume.
struct VolumeOptions {
  /// Colour difference that costs 1 - 1/e units; levels of 255, 1 … 255.
  float colour_scale = 13.0F;
  /// Census distance that costs 1 - 1/e units; bits, 1 … 63.
  float census_scale = 30.0F;
  /// Cost of a match outside the other picture, between the pixel's least (0) and mean cost (1); 0 … 1.
  float out_of_view = kOutOfViewCost;
  CensusOptions census = {};
  /// Costs are averaged over these windows, which are small, so that they reduce noise without flattening
  /// slanted surfaces. An arm has at most kLongestVolumeArm pixels.
  CrossOptions cross = {.row_reach_px = 5,
                        .column_reach_px = 5,
                        .colour_limit = 19,
                        .sure_reach_px = 2,
                        .colour_limit_beyond = 5,
                        .neighbour_limit = 19};
};
/// The sum of a row's costs, of at most 2 units each, fits 16 bits.
inline constexpr int kLongestVolumeArm = 7;
static_assert((2 * kLongestVolumeArm + 1) * 2 * kCostUnit <= 65535);
std::vector<Parameter> parameters_of(VolumeOptions& options);

/// AD-Census cost of Mei et al. 2011, eqs 1-3: 1 - exp(-colour difference / colour_scale) + 1 - exp(-Hamming
/// distance / census_scale), 0…2 units. If x - d is outside the other picture, the cost is between the
/// pixel's least and its mean. The size of `out` gives the number of disparities.
void pixel_costs(const MatchView& reference, const MatchView& other, const VolumeOptions& options,
                 CostVolume& out, const Work& work);

/// Averages the costs over each pixel's cross-shaped region of similar colour (Zhang, Lu & Lafruit 2009).
/// `scratch` has the volume's sizes and is overwritten.
void average_over_crosses(const ColourPlanes& colour, const CrossOptions& cross, CostVolume& volume,
                          CostVolume& scratch, const Work& work);

}  // namespace palpable::vision
