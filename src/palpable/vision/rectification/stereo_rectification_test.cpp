// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/stereo_rectification.hpp"

#include "palpable/vision/stereo/problem/centred_box.hpp"
#include "palpable/vision/stereo/problem/epipolar_pictures.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// The picture rotated about its centre and enlarged, as by a tilted camera with another zoom.
Image turned_and_zoomed(const Image& straight, double degrees, double zoom) {
  Image out = straight;
  const double c = std::cos(degrees * 3.14159265358979 / 180.0) / zoom;
  const double s = std::sin(degrees * 3.14159265358979 / 180.0) / zoom;
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
      out.samples[static_cast<std::size_t>(y * straight.width + x)] = value;
    }
  }
  return out;
}

SyntheticScene sloping_box() {
  SyntheticScene scene = centred_box_scene(320, 240);
  scene.slope_x = 0.02;
  return scene;
}

/// A pair whose right picture is rotated about its centre, as by a tilted camera.
StereoPair turned_pair(double degrees) {
  StereoPair pair = render(sloping_box());
  pair.right = turned_and_zoomed(pair.right, degrees, 1.0);
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
    const auto again = rectify_uncalibrated(
        rectified->pair.frame ? in_epipolar_frame(rectified->pair) : rectified->pair, {});
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

TEST(StereoRectification, DoesNotTakeAZoomForAMovement) {
  const Image picture = render(sloping_box()).left;
  const StereoPair pair{picture, turned_and_zoomed(picture, 2.0, 1.06), {}};
  const auto rectified = rectify_uncalibrated(pair, {});
  ASSERT_TRUE(rectified);
  EXPECT_FALSE(rectified->pair.frame);
  ASSERT_FALSE(rectified->notes.empty());
  EXPECT_THAT(rectified->notes.back(), testing::HasSubstr("Near and far moved alike"));
  const auto match = match_confirmed(rectified->pair, StereoMethod::fast, {}, {});
  ASSERT_TRUE(match);
  EXPECT_FALSE(fit_to_touch(rectified->pair, *match, {}).fit);
}

TEST(StereoRectification, UndoesTheZoomOfACameraThatWasMovedSideways) {
  const SyntheticScene scene = sloping_box();
  StereoPair pair = render(scene);
  pair.right = turned_and_zoomed(pair.right, 0.0, 1.07);
  const auto rectified = rectify_uncalibrated(pair, {});
  ASSERT_TRUE(rectified);
  ASSERT_TRUE(rectified->pair.frame);
  EXPECT_TRUE(rectified->pair.left.samples == pair.left.samples);
  const auto match = match_confirmed(rectified->pair, StereoMethod::fast, {}, {});
  ASSERT_TRUE(match);
  const Raster<float>& disparity_px = match->disparity.disparity_px;
  // The box's middle is nearer than the ground beside and below it.
  EXPECT_GT(disparity_px(160, 120), disparity_px(60, 120) + 3.0F);
  EXPECT_GT(disparity_px(160, 120), disparity_px(160, 200) + 3.0F);
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
