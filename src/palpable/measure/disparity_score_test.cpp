// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/disparity_score.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::measure {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::infinity();

Raster<float> row(std::initializer_list<float> values) {
  Raster<float> out(static_cast<int>(values.size()), 1);
  std::copy(values.begin(), values.end(), out.values().begin());
  return out;
}

TEST(DisparityScore, CountsStrictlyGreaterErrorsAndUnknownAsBad) {
  const auto score = score_disparity(row({10.0F, 11.0F, 12.5F, kUnknown, 3.0F}),
                                     row({10.0F, 10.0F, 10.0F, 10.0F, kUnknown}));
  ASSERT_TRUE(score);
  EXPECT_EQ(score->pixels, 4U);
  EXPECT_DOUBLE_EQ(score->coverage, 0.75);
  EXPECT_DOUBLE_EQ(score->bad_percent[0], 75.0);  // 1, 2.5 and the unknown one exceed 0.5
  EXPECT_DOUBLE_EQ(score->bad_percent[1], 50.0);  // an error of exactly 1 is not bad at 1
  EXPECT_DOUBLE_EQ(score->bad_percent[2], 50.0);
  EXPECT_DOUBLE_EQ(score->bad_percent[3], 25.0);
  EXPECT_DOUBLE_EQ(score->rms_px, std::sqrt((1.0 + 6.25) / 3.0));
}

TEST(DisparityScore, SaysThatTheMaskExcludesTheWholeTruth) {
  const auto score = score_disparity(row({1.0F}), row({1.0F}), Raster<std::uint8_t>(1, 1));
  ASSERT_FALSE(score);
  EXPECT_EQ(score.error().message, "the mask excludes every known pixel of the truth");
}

TEST(DisparityScore, ScoresOnlyWhereTheMaskIsWhite) {
  Raster<std::uint8_t> mask(3, 1);
  mask(1, 0) = 255;
  mask(2, 0) = 255;
  const auto score = score_disparity(row({0.0F, 10.0F, 20.0F}), row({50.0F, 10.0F, 22.0F}), mask);
  ASSERT_TRUE(score);
  EXPECT_EQ(score->pixels, 2U);
  EXPECT_DOUBLE_EQ(score->bad_percent[1], 50.0);
  EXPECT_NEAR(score->rms_percent_of_range, 100.0 * std::sqrt(2.0) / 12.0, 1e-9);
}

TEST(DisparityScore, RefusesSizesThatDifferAndATruthWithoutKnownPixels) {
  EXPECT_FALSE(score_disparity(row({1.0F}), row({1.0F, 2.0F})));
  EXPECT_FALSE(score_disparity(row({1.0F}), row({kUnknown})));
}

}  // namespace
}  // namespace palpable::measure
