// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/undefined_pixels.hpp"

#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

void fill(Image& picture, int left, int right, float value) {
  for (int y = 0; y < picture.height; ++y)
    for (int i = left * picture.channels; i < right * picture.channels; ++i)
      picture.samples[static_cast<std::size_t>(y * picture.width * picture.channels + i)] = value;
}

TEST(UndefinedPixels, AreUnknownInTheMapAndSoAreTheirMatches) {
  const SyntheticScene scene;
  StereoPair pair = render(scene);
  fill(pair.left, 20, 30, kNaN);
  fill(pair.right, 80, 90, std::numeric_limits<float>::infinity());
  const auto found = match(pair, StereoMethod::fast, {}, {});
  ASSERT_TRUE(found) << found.error().sentence();
  const Raster<float>& d = found->disparity.disparity_px;
  const int ground = static_cast<int>(scene.ground_px);
  for (int y = 0; y < 20; ++y) {
    EXPECT_TRUE(std::isnan(d(25, y))) << y;
    EXPECT_EQ(found->confidence(25, y), 0.0F) << y;
    EXPECT_TRUE(std::isnan(d(85 + ground, y))) << y;
    EXPECT_TRUE(std::isfinite(d(50, y))) << y;
  }
}

TEST(UndefinedPixels, APictureOfThemAloneIsRefused) {
  for (const bool left : {true, false}) {
    StereoPair pair = render({});
    Image& picture = left ? pair.left : pair.right;
    fill(picture, 0, picture.width, kNaN);
    const auto found = match(pair, StereoMethod::fast, {}, {});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::invalid_input);
    EXPECT_NE(found.error().message.find(left ? "left" : "right"), std::string::npos);
  }
}

TEST(UndefinedPixels, AlphaDoesNotCount) {
  Image picture{1, 1, 2, 32, {0.5F, kNaN}};
  EXPECT_EQ(undefined_pixels(picture)(0, 0), 0);
  picture.samples[0] = kNaN;
  EXPECT_EQ(undefined_pixels(picture)(0, 0), 1);
}

}  // namespace
}  // namespace palpable::vision
