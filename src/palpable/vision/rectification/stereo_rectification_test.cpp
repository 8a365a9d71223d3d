// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/stereo_rectification.hpp"

#include "palpable/vision/stereo/problem/centred_box.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A pair whose right picture is rotated about its centre, as by a tilted camera.
StereoPair turned_pair(double degrees) {
  SyntheticScene scene = centred_box_scene(320, 240);
  scene.slope_x = 0.02;
  StereoPair pair = render(scene);
  const Image straight = pair.right;
  const double c = std::cos(degrees * 3.14159265358979 / 180.0);
  const double s = std::sin(degrees * 3.14159265358979 / 180.0);
  for (int y = 0; y < straight.height; ++y) {
    for (int x = 0; x < straight.width; ++x) {
      const double u = 159.5 + c * (x - 159.5) - s * (y - 119.5);
      const double v = 119.5 + s * (x - 159.5) + c * (y - 119.5);
      const int i = static_cast<int>(std::floor(u));
      const int j = static_cast<int>(std::floor(v));
      float value = 0.5F;
      if (i >= 0 && j >= 0 && i + 1 < straight.width && j + 1 < straight.height) {
        const auto f = static_cast<float>(u - i);
        const auto g = static_cast<float>(v - j);
        value = (1 - g) * ((1 - f) * *straight.pixel(i, j) + f * *straight.pixel(i + 1, j)) +
                g * ((1 - f) * *straight.pixel(i, j + 1) + f * *straight.pixel(i + 1, j + 1));
      }
      pair.right.samples[static_cast<std::size_t>(y * straight.width + x)] = value;
    }
  }
  return pair;
}

TEST(StereoRectification, AlignsTheRowsOfARotatedPair) {
  for (const double degrees : {-5.0, 3.0}) {
    const auto rectified = rectify_uncalibrated(turned_pair(degrees), {});
    ASSERT_TRUE(rectified) << rectified.error().sentence();
    EXPECT_TRUE(rectified->changed);
    EXPECT_GT(rectified->residual_before_px, 3.0);
    EXPECT_LE(rectified->residual_px, 0.5);
    // The result is rectified: a second run finds little to do.
    const auto again = rectify_uncalibrated(rectified->pair, {});
    ASSERT_TRUE(again);
    EXPECT_LE(again->residual_before_px, 0.6);
  }
}

TEST(StereoRectification, DoesNotChangeARectifiedPair) {
  const StereoPair pair = turned_pair(0.0);
  const auto rectified = rectify_uncalibrated(pair, {});
  ASSERT_TRUE(rectified);
  EXPECT_FALSE(rectified->changed);
  EXPECT_TRUE(rectified->pair.right.samples == pair.right.samples);
}

TEST(StereoRectification, ReturnsAPairWithoutFeaturesUnchangedWithANote) {
  StereoPair pair = turned_pair(0.0);
  std::fill(pair.left.samples.begin(), pair.left.samples.end(), 0.5F);
  const auto rectified = rectify_uncalibrated(pair, {});
  ASSERT_TRUE(rectified);
  EXPECT_FALSE(rectified->changed);
  ASSERT_FALSE(rectified->notes.empty());
}

}  // namespace
}  // namespace palpable::vision
