// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/least_cost.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(LeastCost, IsTheFirstLeastAndTheLeastElsewhere) {
  std::vector<std::uint16_t> costs(70, 500);
  costs[20] = 90;
  costs[21] = 100;  // beside the least: not elsewhere
  costs[60] = 110;
  const LeastCost least = least_cost(costs.data(), 70);
  EXPECT_EQ(least.at, 20);
  EXPECT_EQ(least.cost, 90);
  EXPECT_EQ(least.elsewhere, 110);
  costs[50] = 90;
  EXPECT_EQ(least_at(costs.data(), 70), 20);
  EXPECT_EQ(least_cost(costs.data(), 70).elsewhere, 90);
}

TEST(LeastCost, OfOneHasNoneElsewhere) {
  const std::uint16_t cost = 7;
  EXPECT_EQ(least_cost(&cost, 1).cost, 7);
  EXPECT_GE(least_cost(&cost, 1).elsewhere, 65535);
}

TEST(KeptLeast, ReplacesOnlyHigherCosts) {
  const std::array<std::uint16_t, 3> costs{5, 9, 7};
  std::array<std::uint16_t, 3> least{6, 8, 7}, from{1, 1, 1};
  keep_least(costs.data(), 42, 3, least.data(), from.data());
  EXPECT_EQ(least, (std::array<std::uint16_t, 3>{5, 8, 7}));
  EXPECT_EQ(from, (std::array<std::uint16_t, 3>{42, 1, 1}));
}

}  // namespace
}  // namespace palpable::vision
