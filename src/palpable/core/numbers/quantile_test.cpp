// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/numbers/quantile.hpp"

#include "palpable/core/numbers/median.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(Quantile, IsOneOfTheValuesTheLowerBetweenTwo) {
  std::vector<double> values{5.0, 1.0, 4.0, 2.0, 3.0};
  EXPECT_EQ(quantile_of(values, 0.0), 1.0);
  EXPECT_EQ(quantile_of(values, 0.5), 3.0);
  EXPECT_EQ(quantile_of(values, 0.74), 3.0);
  EXPECT_EQ(quantile_of(values, 0.75), 4.0);
  EXPECT_EQ(quantile_of(values, 1.0), 5.0);
  std::vector<float> one{7.0F};
  EXPECT_EQ(quantile_of(one, 0.3), 7.0F);
}

TEST(Median, IsTheMiddleValueTheUpperOfTwo) {
  EXPECT_EQ(median_of(std::vector<double>{3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median_of(std::vector<double>{4.0, 1.0, 3.0, 2.0}), 3.0);
  EXPECT_EQ(median_of(std::vector<float>{7.0F}), 7.0F);
}

}  // namespace
}  // namespace palpable
