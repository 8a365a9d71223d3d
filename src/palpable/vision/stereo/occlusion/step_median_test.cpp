// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/step_median.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 60, kHeight = 40, kEdge = 30;

/// A dark slanted wall on the left, and a bright board on the right whose disparities reach `beyond_px` into
/// the wall.
struct BoardBeforeWall {
  ColourPlanes colour;
  Raster<float> truth_px{kWidth, kHeight, 12.0F};
  Raster<float> found_px = truth_px;

  explicit BoardBeforeWall(int beyond_px) {
    Raster<std::uint8_t> plane(kWidth, kHeight, 180);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kEdge; ++x) {
        plane(x, y) = 60;
        truth_px(x, y) = 4.0F + 0.03F * static_cast<float>(x);
        found_px(x, y) = x < kEdge - beyond_px ? truth_px(x, y) : 12.0F;
      }
    colour = {plane, plane, plane};
  }
};

TEST(StepMedian, MovesAStepToTheEdgeOfColour) {
  BoardBeforeWall scene(2);
  median_at_steps(scene.colour, {}, scene.found_px, {});
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      EXPECT_NEAR(scene.found_px(x, y), scene.truth_px(x, y), 0.5) << x << ' ' << y;
}

TEST(StepMedian, KeepsSlopesBesideAStep) {
  BoardBeforeWall scene(0);
  median_at_steps(scene.colour, {}, scene.found_px, {});
  EXPECT_EQ(scene.found_px, scene.truth_px);
}

TEST(StepMedian, ChangesNothingFarFromSteps) {
  BoardBeforeWall scene(0);
  scene.found_px(5, 5) += 0.9F;
  const float before = scene.found_px(5, 5);
  median_at_steps(scene.colour, {}, scene.found_px, {});
  EXPECT_EQ(scene.found_px(5, 5), before);
}

TEST(StepMedian, TheResultDoesNotDependOnTheNumberOfThreads) {
  BoardBeforeWall one(4), four = one;
  Work work;
  work.threads = 1;
  median_at_steps(one.colour, {.rounds = 2}, one.found_px, work);
  work.threads = 4;
  median_at_steps(four.colour, {.rounds = 2}, four.found_px, work);
  EXPECT_EQ(one.found_px, four.found_px);
}

TEST(StepMedian, KeepsADisparityThatOthersOfItsColourSupport) {
  BoardBeforeWall scene(0);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 14; x < 20; ++x) scene.found_px(x, y) = 9.0F;  // a rod of the wall's colour
  Raster<float> median_alone = scene.found_px;
  const Raster<float> before = scene.found_px;
  median_at_steps(scene.colour, {}, scene.found_px, {});
  for (int y = 0; y < kHeight; ++y) EXPECT_EQ(scene.found_px(17, y), before(17, y)) << y;
  median_at_steps(scene.colour, {.enough_support = 1.0F}, median_alone, {});
  EXPECT_LT(median_alone(17, 20), 5.5F);
}

TEST(StepMedian, NoRoundsChangeNothing) {
  BoardBeforeWall scene(3);
  const Raster<float> before = scene.found_px;
  median_at_steps(scene.colour, {.rounds = 0}, scene.found_px, {});
  EXPECT_EQ(scene.found_px, before);
}

}  // namespace
}  // namespace palpable::vision
