// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plane_search.hpp"

#include "palpable/vision/stereo/planes/plain_picture.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kSearchWidth = 90;
constexpr int kSearchHeight = 40;

TEST(PlaneSearch, FindsASlantFromAFlatStart) {
  // A cost with its minimum on a plane, starting from integer steps.
  CostVolume costs(kSearchWidth, kSearchHeight, 20);
  const auto truth = [](int x, int y) {
    return 3.0F + 0.12F * static_cast<float>(x) + 0.05F * static_cast<float>(y);
  };
  PlaneMap start(kSearchWidth, kSearchHeight);
  for (int y = 0; y < kSearchHeight; ++y)
    for (int x = 0; x < kSearchWidth; ++x) {
      start.disparity(x, y) = std::round(truth(x, y));
      for (int d = 0; d < 20; ++d) {
        const float off = static_cast<float>(d) - truth(x, y);
        costs.at(x, y)[d] = static_cast<std::uint16_t>(std::min(4000.0F, 200.0F * off * off));
      }
    }
  const ColourPlanes colour = plain_picture(kSearchWidth, kSearchHeight);
  const Raster<float> all(kSearchWidth, kSearchHeight, 1.0F);
  const Regions whole{Raster<std::int32_t>(kSearchWidth, kSearchHeight, 0), {kSearchWidth * kSearchHeight}};
  PlaneCandidates candidates(kSearchWidth, kSearchHeight);
  PlaneMap map = start;
  for (int round = 0; round < 4; ++round) {
    propose_planes(colour, {map, start, all, whole}, {}, round, candidates, {});
    plane_costs(costs, {}, {}, candidates, {});
    choose_planes(colour, {}, candidates, map, {});
  }
  double error = 0.0;
  double slope_error = 0.0;
  int pixels = 0;
  for (int y = 5; y < kSearchHeight - 5; ++y)
    for (int x = 20; x < kSearchWidth - 5; ++x) {
      error += std::abs(map.disparity(x, y) - truth(x, y));
      slope_error += std::abs(map.slope_x(x, y) - 0.12F) + std::abs(map.slope_y(x, y) - 0.05F);
      ++pixels;
    }
  EXPECT_LT(error / pixels, 0.1);
  EXPECT_LT(slope_error / pixels, 0.05);
}

/// A volume whose costs are c(d) = 400 d in 1/kCostUnit, at every pixel.
CostVolume ramp(int disparities) {
  CostVolume costs(8, 1, disparities);
  for (int x = 0; x < 8; ++x)
    for (int d = 0; d < disparities; ++d) costs.at(x, 0)[d] = static_cast<std::uint16_t>(400 * d);
  return costs;
}

TEST(MatchingCostAt, IsCubicBetweenDisparitiesAndLinearBeyondTheirEnds) {
  const CostVolume costs = ramp(6);
  constexpr float kStep = 400.0F / kCostUnit;
  EXPECT_NEAR(matching_cost_at(costs, 3, 0, 2.25F, 0.5F), 2.25F * kStep, 1e-6F);
  EXPECT_NEAR(matching_cost_at(costs, 3, 0, -2.0F, 0.5F), 1.0F, 1e-6F);
  EXPECT_NEAR(matching_cost_at(costs, 3, 0, 6.0F, 0.5F), 5.0F * kStep + 0.5F, 1e-6F);
}

/// The cost of a level candidate of this disparity at (7, 0), whose matching cost is 0, where the other view
/// sees `seen`.
float cost_beside(float disparity, float seen) {
  const CostVolume costs(8, 1, 6);
  const Raster<float> other(8, 1, seen);
  PlaneCandidates candidates(8, 1);
  std::fill(candidates.disparity.begin(), candidates.disparity.end(), disparity);
  plane_costs(costs, {&other, 0.0F}, {}, candidates, {});
  return candidates.cost[candidates.at(7, 0)];
}

TEST(PlaneCosts, AreTheHiddenCostBehindTheOtherViewsSurface) {
  const PlaneCostOptions options;
  EXPECT_EQ(cost_beside(2.0F, 5.0F), options.hidden_cost);
  EXPECT_NEAR(cost_beside(2.0F, 3.25F), 0.5F * options.hidden_cost, 1e-6F);  // half way up the ramp
}

TEST(PlaneCosts, AreTheConflictCostInFrontOfIt) {
  const PlaneCostOptions options;
  EXPECT_EQ(cost_beside(4.0F, 1.0F), options.conflict_cost);
  EXPECT_EQ(cost_beside(4.0F, 4.5F), 0.0F);  // both agree
}

TEST(PlaneCosts, GrowWithTheSlope) {
  const CostVolume costs(8, 1, 6);
  PlaneCandidates candidates(8, 1);
  std::fill(candidates.disparity.begin(), candidates.disparity.end(), 2.0F);
  std::fill(candidates.slope_x.begin(), candidates.slope_x.end(), -0.5F);
  std::fill(candidates.slope_y.begin(), candidates.slope_y.end(), 0.25F);
  plane_costs(costs, {}, {}, candidates, {});
  EXPECT_NEAR(candidates.cost[candidates.at(7, 0)], 0.75F * PlaneCostOptions{}.slope_cost, 1e-6F);
}

TEST(PlaneCosts, AreNoMoreBehindANearerSurfaceThanOnIt) {
  CostVolume costs = ramp(6);
  costs.at(7, 0)[0] = 2000;
  costs.at(7, 0)[4] = 100;  // elsewhere costs rise by 400 a disparity
  Raster<float> nearer_px(8, 1, NAN);
  nearer_px(7, 0) = 4.0F;
  PlaneCandidates candidates(8, 1);
  std::fill(candidates.disparity.begin(), candidates.disparity.end(), 2.0F);
  const std::size_t marked = candidates.at(7, 0);
  candidates.disparity[marked + 1] = 5.0F;
  candidates.disparity[marked + 2] = -2.0F;  // 2 px beyond the range
  plane_costs(costs, {}, {}, candidates, {}, &nearer_px);
  const float on_it = matching_cost_at(costs, 7, 0, 4.0F, 0.0F);
  EXPECT_NEAR(candidates.cost[marked], on_it, 1e-6F);
  EXPECT_NEAR(candidates.cost[marked + 1], matching_cost_at(costs, 7, 0, 5.0F, 0.0F), 1e-6F);
  EXPECT_GT(candidates.cost[marked + 1], on_it);
  EXPECT_NEAR(candidates.cost[marked + 2], on_it + 2.0F * PlaneCostOptions{}.beyond_range_per_px, 1e-6F);
  EXPECT_NEAR(candidates.cost[candidates.at(6, 0)], matching_cost_at(costs, 6, 0, 2.0F, 0.0F), 1e-6F);
}

TEST(ChosenPlanes, AreOfLeastCostWithoutSmoothness) {
  PlaneCandidates candidates(5, 4);
  for (std::size_t i = 0; i < candidates.cost.size(); ++i) {
    candidates.disparity[i] = static_cast<float>(i % PlaneCandidates::kCount);
    candidates.cost[i] =
        (i / PlaneCandidates::kCount) % PlaneCandidates::kCount == i % PlaneCandidates::kCount ? 0.0F : 1.0F;
  }
  PlaneMap map(5, 4);
  choose_planes(plain_picture(5, 4), {.step_per_px = 0.0F, .largest_step = 0.0F}, candidates, map, {});
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(map.disparity(i % 5, i / 5), static_cast<float>(i % PlaneCandidates::kCount));
}

TEST(ChosenPlanes, OverruleASinglePixelByItsSurroundings) {
  PlaneCandidates candidates(9, 9);
  for (std::size_t i = 0; i < candidates.cost.size(); ++i) {
    const bool near = i % PlaneCandidates::kCount == 0;
    candidates.disparity[i] = near ? 3.0F : 8.0F;
    candidates.cost[i] = near ? 0.0F : 1.0F;
  }
  const std::size_t middle = candidates.at(4, 4);
  candidates.cost[middle] = 1.0F;
  candidates.cost[middle + 5] = 0.0F;
  PlaneMap map(9, 9);
  choose_planes(plain_picture(9, 9), {}, candidates, map, {});
  EXPECT_EQ(map.disparity(4, 4), 3.0F);
}

}  // namespace
}  // namespace palpable::vision
