// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/ink_coverage.hpp"

#include <cstdint>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(InkCoverage, IsThePartOfAMixtureAndNothingOfOtherColours) {
  constexpr Rgb8 kGround{250, 210, 160}, kInk{50, 50, 50}, kHalf{150, 130, 105}, kDarker{20, 25, 35},
      kBorder{160, 107, 0};
  Raster<Rgb8> picture(40, 20, kGround);
  picture(5, 10) = kInk;
  picture(15, 10) = kHalf;
  picture(25, 10) = kDarker;
  picture(35, 10) = kBorder;
  const cv::Mat coverage = coverage_of(picture, kInk, 7, 45.0);
  EXPECT_EQ(coverage.at<std::uint8_t>(10, 5), 255);
  EXPECT_NEAR(coverage.at<std::uint8_t>(10, 15), 127, 2);
  EXPECT_EQ(coverage.at<std::uint8_t>(10, 25), 255)
      << "the mean colour of strokes is lighter than their core";
  EXPECT_LT(coverage.at<std::uint8_t>(10, 35), 60);
  EXPECT_EQ(coverage.at<std::uint8_t>(3, 3), 0);
}

}  // namespace
}  // namespace palpable::vision
