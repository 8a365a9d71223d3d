// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/photograph_check.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace palpable::vision {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A drawing of a circle and a square in dark strokes on bright paper: strokes with edges of `blur` (standard
/// deviation, pixels), levels multiplied by `light`, normal noise added.
Image photograph(double blur, double light, double noise) {
  constexpr int kWidth = 640, kHeight = 480;
  std::mt19937 random(7);
  std::normal_distribution<double> grain(0.0, noise);
  Image image{kWidth, kHeight, 1, 8, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double circle = std::abs(std::hypot(x - 200.0, y - 220.0) - 110.0);
      const double square = std::abs(std::max(std::abs(x - 450.0), std::abs(y - 260.0)) - 90.0);
      const double outside = std::min(circle, square) - 3.0;
      const double ink = 0.5 * std::erfc(outside / (std::sqrt(2.0) * std::max(blur, 0.3)));
      const double level = light * (0.95 - 0.85 * ink) + (noise > 0.0 ? grain(random) : 0.0);
      image.samples.push_back(static_cast<float>(std::round(255.0 * std::clamp(level, 0.0, 1.0)) / 255.0));
    }
  return image;
}

std::string verdict(double blur, double light, double noise) {
  return photograph_verdict(photograph_quality(photograph(blur, light, noise)));
}

TEST(PhotographCheck, HasNothingToSayAboutAGoodPicture) {
  EXPECT_EQ(verdict(0.7, 1.0, 0.0), "");
  EXPECT_EQ(verdict(1.0, 0.8, 0.02), "");
}

TEST(PhotographCheck, SaysWhatIsWrongAndWhatToDo) {
  EXPECT_THAT(verdict(0.7, 0.25, 0.0), HasSubstr("dark (its brightest parts reach 24 % of white)"));
  EXPECT_THAT(verdict(0.7, 0.25, 0.0), HasSubstr("take it again in brighter light."));
  EXPECT_THAT(verdict(0.7, 1.0, 0.2), HasSubstr("noisy"));
  EXPECT_THAT(verdict(0.7, 1.0, 0.2), Not(HasSubstr("blurred")));
  EXPECT_THAT(verdict(6.0, 1.0, 0.0), HasSubstr("blurred"));
  EXPECT_THAT(verdict(6.0, 1.0, 0.0), HasSubstr("take it again in focus, with the camera held still."));
  const std::string all = verdict(6.0, 0.25, 0.04);
  for (const char* const what : {"dark", "noisy", "blurred", "in brighter light and in focus"})
    EXPECT_THAT(all, HasSubstr(what));
}

TEST(PhotographCheck, MeasuresNoiseAndTheWidthOfEdges) {
  EXPECT_NEAR(photograph_quality(photograph(0.7, 0.6, 0.05)).noise, 0.05, 0.01);
  // An edge blurred by a Gaussian has the width sqrt(2 pi) times its deviation, where the stroke is wider:
  // here its other edge leaves 38 % of the level at its middle (erfc(3 / (6 sqrt 2)) = 0.617).
  EXPECT_NEAR(photograph_quality(photograph(6.0, 1.0, 0.0)).blur, 0.617 * 6.0 * 2.507 / 640.0, 0.004);
}

}  // namespace
}  // namespace palpable::vision
