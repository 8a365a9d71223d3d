// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/filling.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Fills a row in which disparities below 0 are untrusted.
std::vector<float> filled(const std::vector<float>& row) {
  Raster<float> disparity(static_cast<int>(row.size()), 1);
  Raster<std::uint8_t> trusted(disparity.width(), 1);
  for (std::size_t x = 0; x < row.size(); ++x) {
    disparity.values()[x] = row[x];
    trusted.values()[x] = row[x] >= 0.0F ? 1 : 0;
  }
  fill_from_background(trusted, disparity);
  return {disparity.values().begin(), disparity.values().end()};
}

TEST(Filling, TakesTheLowerOfBothEnds) {
  EXPECT_EQ(filled({3, -1, -1, 8, -1, 5}), (std::vector<float>{3, 3, 3, 8, 5, 5}));
}

TEST(Filling, TakesTheOnlyEndAtTheBorder) {
  EXPECT_EQ(filled({-1, -1, 4, 9, -1}), (std::vector<float>{4, 4, 4, 9, 9}));
}

TEST(Filling, KeepsARowWithoutATrustedPixel) { EXPECT_EQ(filled({-1, -2}), (std::vector<float>{-1, -2})); }

}  // namespace
}  // namespace palpable::vision
