// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/sub_pixel.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(SubPixelOffset, IsTheMinimumOfTheParabola) {
  // 100 (d - 2.2)^2.
  const std::array<int, 5> costs{484, 144, 4, 64, 324};
  EXPECT_NEAR(sub_pixel_offset(costs.data(), 2, 5), 0.2F, 1e-6F);
  EXPECT_NEAR(sub_pixel_offset(costs.data(), 3, 5), -0.5F, 1e-6F);  // at most half a pixel
}

TEST(SubPixelOffset, IsZeroAtTheEndsAndForCostsThatAreNotConvex) {
  const std::array<int, 3> convex{9, 4, 5}, level{5, 5, 5};
  EXPECT_EQ(sub_pixel_offset(convex.data(), 0, 3), 0.0F);
  EXPECT_EQ(sub_pixel_offset(convex.data(), 2, 3), 0.0F);
  EXPECT_EQ(sub_pixel_offset(level.data(), 1, 3), 0.0F);
}

TEST(Membrane, TurnsIntegerLabelsIntoASlope) {
  Raster<int> label(80, 12);
  const auto truth = [](int x) { return 3.0F + 0.25F * static_cast<float>(x); };
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 80; ++x) label(x, y) = static_cast<int>(std::lround(truth(x)));
  const Raster<float> surface = membrane_through(label, 60, {});
  for (int x = 10; x < 70; ++x) EXPECT_NEAR(surface(x, 6), truth(x), 0.15F) << x;
}

TEST(Membrane, IsCutWhereLabelsDifferByMoreThanOne) {
  Raster<int> label(20, 4, 3);
  for (int y = 0; y < 4; ++y)
    for (int x = 10; x < 20; ++x) label(x, y) = 8;
  const Raster<float> surface = membrane_through(label, 40, {});
  EXPECT_EQ(surface(9, 2), 3.0F);
  EXPECT_EQ(surface(10, 2), 8.0F);
}

}  // namespace
}  // namespace palpable::vision
