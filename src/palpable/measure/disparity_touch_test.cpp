// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/disparity_touch.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::measure {
namespace {

/// A ramp over 100 x 80 pixels: 1 mm a pixel, 15 mm from the left to the right.
Raster<float> ramp(double tilt_mm_per_row = 0.0) {
  Raster<float> out(100, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 100; ++x) out(x, y) = static_cast<float>(15.0 * x / 99.0 + tilt_mm_per_row * y);
  return out;
}

TEST(DisparityTouch, IsZeroForTheTruthItself) {
  const auto touch = touch_of_disparity(ramp(), ramp());
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->normal_error_deg, 0.0, 1e-3);
  EXPECT_EQ(touch->spurious_steps_per_cm, 0.0);
  EXPECT_NEAR(touch->path_cm, 0.1 * (99 * 80 + 100 * 79), 1e-9);
}

TEST(DisparityTouch, MeasuresATiltAsItsAngle) {
  const auto touch = touch_of_disparity(ramp(0.1), ramp());
  ASSERT_TRUE(touch);
  // Normals of slopes (15/99, 0) and (15/99, 0.1).
  const double s = 15.0 / 99.0;
  const double cosine = (s * s + 1.0) / std::sqrt((s * s + 1.0) * (s * s + 0.01 + 1.0));
  EXPECT_NEAR(touch->normal_error_deg, 180.0 / std::numbers::pi * std::acos(cosine), 0.01);
  EXPECT_EQ(touch->spurious_steps_per_cm, 0.0);
}

TEST(DisparityTouch, CountsFalseSteps) {
  Raster<float> stepped = ramp();
  for (int y = 0; y < 80; ++y)
    for (int x = 50; x < 100; ++x) stepped(x, y) += 0.6F;
  const auto touch = touch_of_disparity(stepped, ramp());
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->spurious_steps_per_cm * touch->path_cm, 80.0, 1e-6);
}

TEST(DisparityTouch, IgnoresUnknownAndMaskedPixels) {
  Raster<float> hole = ramp();
  hole(10, 10) = std::numeric_limits<float>::quiet_NaN();
  Raster<std::uint8_t> mask(100, 80, 255);
  mask(90, 70) = 0;
  const auto touch = touch_of_disparity(hole, ramp(), mask);
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->path_cm, 0.1 * (99 * 80 + 100 * 79 - 8), 1e-9);
}

TEST(DisparityTouch, RefusesATruthOfOneValueAndSizesThatDiffer) {
  EXPECT_FALSE(touch_of_disparity(ramp(), Raster<float>(100, 80, 3.0F)));
  EXPECT_FALSE(touch_of_disparity(Raster<float>(10, 80, 3.0F), ramp()));
}

}  // namespace
}  // namespace palpable::measure
