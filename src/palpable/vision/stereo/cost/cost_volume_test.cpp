// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/cost_volume.hpp"

#include "palpable/vision/stereo/cost/moved_texture.hpp"
#include "palpable/vision/stereo/cost/sgm.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(PixelCosts, FollowTheEquation) {
  // One pixel with all census bits and 26 levels of colour different: 1 - e^(-26/13) + 1 - e^(-63/30).
  const auto view = [](std::uint8_t level, std::uint64_t census) {
    const Raster<std::uint8_t> plane(1, 1, level);
    return MatchView{{plane, plane, plane},
                     Raster<std::uint64_t>(1, 1, census),
                     Raster<std::uint64_t>(1, 1, (std::uint64_t{1} << 63U) - 1U)};
  };
  CostVolume costs(1, 1, 1);
  pixel_costs(view(100, 0), view(126, (std::uint64_t{1} << 63U) - 1U), {}, costs, {});
  EXPECT_NEAR(costs.at(0, 0)[0] / static_cast<double>(kCostUnit), 2.0 - std::exp(-2.0) - std::exp(-2.1),
              1e-3);
  pixel_costs(view(100, 5), view(100, 5), {}, costs, {});
  EXPECT_EQ(costs.at(0, 0)[0], 0);
}

TEST(PixelCosts, AreLeastAtTheTrueDisparityAndMostlyForDifferentExposures) {
  const MatchView left = moved_texture(0, 1.0);
  for (const auto& [gain, percent] : {std::pair{1.0, 95}, std::pair{0.6, 60}}) {
    CostVolume costs(kTextureWidth, kTextureHeight, 20);
    pixel_costs(left, moved_texture(kTextureShift, gain), {}, costs, {});
    int right = 0;
    const Raster<float> found = least_cost_disparity(costs, {});
    for (int y = 4; y < kTextureHeight - 4; ++y)
      for (int x = 25; x < kTextureWidth - 12; ++x)
        right += std::abs(found(x, y) - kTextureShift) < 0.75F ? 1 : 0;
    EXPECT_GE(right, (kTextureHeight - 8) * (kTextureWidth - 37) * percent / 100) << gain;
  }
}

TEST(PixelCosts, AreNeutralForAMatchOutsideThePicture) {
  CostVolume costs(kTextureWidth, kTextureHeight, 20);
  pixel_costs(moved_texture(0, 1.0), moved_texture(kTextureShift, 1.0), {}, costs, {});
  const std::uint16_t* cost = costs.at(9, 20);
  const std::uint16_t least = *std::min_element(cost, cost + 10);
  const std::uint16_t greatest = *std::max_element(cost, cost + 10);
  for (int d = 10; d < 20; ++d) {
    EXPECT_GT(cost[d], least);
    EXPECT_LT(cost[d], greatest);
  }
}

TEST(PixelCosts, OfAPlainSurfaceDoNotFavourAnAdjacentEdge) {
  // A bright bar that moves by kTextureShift before a plain wall: at the wall's pixels beside the bar the
  // census window contains the moving bar, but the bits that count do not.
  const auto bar = [](int shift) {
    Raster<Rgb8> colour(kTextureWidth, kTextureHeight, Rgb8{90, 90, 90});
    Raster<std::uint8_t> luma(kTextureWidth, kTextureHeight, 90);
    for (int y = 0; y < kTextureHeight; ++y)
      for (int x = 40; x < 60; ++x) {
        colour(x - shift, y) = {200, 200, 200};
        luma(x - shift, y) = 200;
      }
    return match_view(colour, luma, {}, {});
  };
  CostVolume costs(kTextureWidth, kTextureHeight, 20);
  pixel_costs(bar(0), bar(kTextureShift), {}, costs, {});
  for (const int beside : {1, 2, 3}) {
    const std::uint16_t* cost = costs.at(59 + beside, kTextureHeight / 2);
    EXPECT_EQ(cost[0], cost[kTextureShift]) << beside;
  }
}

TEST(AveragedCosts, OfAUniformPictureEqualThoseOfOnePixel) {
  const MatchView flat{ColourPlanes{Raster<std::uint8_t>(20, 12, 50), Raster<std::uint8_t>(20, 12, 50),
                                    Raster<std::uint8_t>(20, 12, 50)},
                       Raster<std::uint64_t>(20, 12), Raster<std::uint64_t>(20, 12)};
  CostVolume costs(20, 12, 4);
  CostVolume scratch = costs;
  std::fill(costs.cost.begin(), costs.cost.end(), std::uint16_t{4096});
  average_over_crosses(flat.colour, VolumeOptions{}.cross, costs, scratch, {});
  for (const std::uint16_t c : costs.cost) EXPECT_EQ(c, 4096);
}

}  // namespace
}  // namespace palpable::vision
