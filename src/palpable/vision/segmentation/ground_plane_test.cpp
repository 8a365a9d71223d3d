// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/ground_plane.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 320, kHeight = 240;

/// A plane with noise; nearer boxes hide a third of it.
Raster<float> covered(const DisparityPlane& plane, double sigma_px) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, sigma_px);
  Raster<float> out(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool box = x % 80 > 30 && y % 60 > 20;
      out(x, y) = static_cast<float>(plane.at(x, y) + (box ? 4.0 + (x / 80) : 0.0) + noise(random));
    }
  return out;
}

void expect_plane(const DisparityPlane& found, const DisparityPlane& truth, double most_px) {
  for (const int y : {0, kHeight - 1})
    for (const int x : {0, kWidth - 1}) EXPECT_NEAR(found.at(x, y), truth.at(x, y), most_px) << x << " " << y;
}

TEST(FindGroundPlane, RecoversTheRisingPlaneUnderBoxes) {
  const DisparityPlane truth{0.01, 0.08, 5.0};
  const auto found = find_ground_plane(covered(truth, 0.1), Work{});
  ASSERT_TRUE(found);
  expect_plane(found->plane, truth, 0.1);
  EXPECT_NEAR(found->sigma_px, 0.1, 0.03);
}

TEST(FindGroundPlane, RefusesALevelPlaneThatABackPlaneMayBe) {
  const DisparityPlane truth{0.003, 0.0, 12.0};
  Raster<float> bare(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) bare(x, y) = static_cast<float>(truth.at(x, y));
  EXPECT_FALSE(find_ground_plane(bare, Work{}));
  const auto back = find_back_plane(covered(truth, 0.1), Work{});
  ASSERT_TRUE(back);
  expect_plane(back->plane, truth, 0.1);
}

TEST(FindBackPlane, IsAbsentIfNothingIsKnown) {
  EXPECT_FALSE(
      find_back_plane(Raster<float>(kWidth, kHeight, std::numeric_limits<float>::quiet_NaN()), Work{}));
}

}  // namespace
}  // namespace palpable::vision
