// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/sgm.hpp"

#include "palpable/vision/stereo/cost/moved_texture.hpp"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(AggregatedPaths, FindTheShiftOfATexture) {
  const MatchView left = moved_texture(0, 1.0);
  const MatchView right = moved_texture(kTextureShift, 1.0);
  CostVolume costs(kTextureWidth, kTextureHeight, 20);
  CostVolume sums = costs;
  pixel_costs(left, right, {}, costs, {});
  aggregate_paths(costs, left.colour, right.colour, {}, sums, {});
  const Raster<float> here = least_cost_disparity(sums, {});
  for (int y = 2; y < kTextureHeight - 2; ++y)
    for (int x = 12; x < kTextureWidth - 12; ++x)
      EXPECT_NEAR(here(x, y), kTextureShift, 0.75) << x << ' ' << y;
}

/// One row of two pixels of one colour; the costs of the first and of the second at three disparities.
CostVolume sums_of(const std::array<std::uint16_t, 3>& first, const std::array<std::uint16_t, 3>& second,
                   const SgmOptions& options) {
  CostVolume costs(2, 1, 3);
  std::copy(first.begin(), first.end(), costs.at(0, 0));
  std::copy(second.begin(), second.end(), costs.at(1, 0));
  CostVolume sums(2, 1, 3);
  const Raster<std::uint8_t> plane(2, 1, 90);
  aggregate_paths(costs, {plane, plane, plane}, {plane, plane, plane}, options, sums, {});
  return sums;
}

TEST(AggregatedPaths, MatchTheDefinitionOnTwoPixels) {
  // At the second pixel: the path from the left costs C(d) + min(L(d), L(d ± 1) + P1, min L + P2) - min L,
  // and the paths from the right, from above and from below begin there, with C(d) each.
  const SgmOptions options{.small_step = 0.25F, .large_step = 0.75F};
  const CostVolume sums = sums_of({0, 2000, 2000}, {100, 200, 300}, options);
  EXPECT_EQ(sums.at(1, 0)[0], 4 * 100 + 0);
  EXPECT_EQ(sums.at(1, 0)[1], 4 * 200 + kCostUnit / 4);
  EXPECT_EQ(sums.at(1, 0)[2], 4 * 300 + kCostUnit * 3 / 4);
}

TEST(LeastCostDisparity, IsTheMinimumOfTheParabola) {
  // 40 (d - 1.25)^2 + 10 at d = 0, 1, 2.
  CostVolume costs(1, 1, 3);
  const std::array<double, 3> values{72.5, 12.5, 32.5};
  for (int d = 0; d < 3; ++d)
    costs.at(0, 0)[d] = static_cast<std::uint16_t>(2.0 * values[static_cast<std::size_t>(d)]);
  EXPECT_NEAR(least_cost_disparity(costs, {})(0, 0), 1.25F, 1e-6F);
}

}  // namespace
}  // namespace palpable::vision
