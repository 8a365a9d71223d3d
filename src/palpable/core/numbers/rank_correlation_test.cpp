// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/numbers/rank_correlation.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(RankCorrelation, IsOneForTheSameOrderAndMinusOneForTheReverse) {
  const std::vector<double> rising{1, 2, 30, 400}, other{-5, -4, 0, 0.1}, falling{9, 8, 7, -1};
  EXPECT_DOUBLE_EQ(rank_correlation(rising, other), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(rising, falling), -1.0);
}

TEST(RankCorrelation, SharesTheMeanPlaceAmongEqualValues) {
  EXPECT_EQ(ranks_of(std::vector<int>{7, 3, 7, 1}), (std::vector<double>{2.5, 1.0, 2.5, 0.0}));
}

TEST(RankCorrelation, IsZeroWhereNothingVaries) {
  EXPECT_EQ(rank_correlation(std::vector<float>{1, 1, 1}, std::vector<float>{1, 2, 3}), 0.0);
  EXPECT_EQ(rank_correlation(std::vector<float>{}, std::vector<float>{}), 0.0);
}

}  // namespace
}  // namespace palpable
