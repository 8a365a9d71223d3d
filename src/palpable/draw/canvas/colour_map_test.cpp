// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/colour_map.hpp"

#include <gtest/gtest.h>

namespace palpable::draw {
namespace {

TEST(DepthColour, LightensInEqualSteps) {
  for (int i = 0; i < 20; ++i) {
    const double step = lightness(depth_colour((i + 1) / 20.0)) - lightness(depth_colour(i / 20.0));
    EXPECT_NEAR(step, 0.68 / 20.0, 0.008) << "step " << i;
  }
}

TEST(DepthColour, ClampsOutsideItsRange) {
  EXPECT_EQ(depth_colour(-3.0), depth_colour(0.0));
  EXPECT_EQ(depth_colour(7.0), depth_colour(1.0));
}

TEST(TintColour, StaysLightEnoughForShading) {
  for (int i = 0; i <= 10; ++i) EXPECT_GT(lightness(tint_colour(i / 10.0)), 0.65);
}

TEST(Lightness, IsOneForWhiteAndZeroForBlack) {
  EXPECT_NEAR(lightness({255, 255, 255}), 1.0, 1e-3);
  EXPECT_NEAR(lightness({0, 0, 0}), 0.0, 1e-9);
}

}  // namespace
}  // namespace palpable::draw
