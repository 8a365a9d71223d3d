// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/matching_cost.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A matching cost for each pixel and disparity, the disparities of a pixel side by side and padded to whole
/// vectors. Costs are in units of 1/kCostUnit.
struct CostVolume {
  int width = 0;
  int height = 0;
  int disparities = 0;
  /// Values per pixel, a multiple of 32; those from `disparities` on are not meant to be read.
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

/// AD-Census cost of Mei et al. 2011, eqs 1-3: 1 - exp(-colour difference/10) + 1 - exp(-Hamming
/// distance/30), 0…2 units. Where x - d lies outside the other picture, a value between the pixel's least and
/// its mean cost, so that being out of view neither attracts nor repels. The result is written into `out`,
/// whose sizes say how many disparities are asked for.
void pixel_costs(const MatchView& reference, const MatchView& other, CostVolume& out, const Work& work);

/// Averages the costs over each pixel's cross-shaped region of like colour (Zhang, Lu & Lafruit 2009), with
/// arms of at most 5 pixels: enough against noise, little enough not to flatten slanted surfaces.
/// `scratch` has the volume's sizes and is overwritten.
void average_over_crosses(const ColourPlanes& colour, CostVolume& volume, CostVolume& scratch,
                          const Work& work);

}  // namespace palpable::vision
