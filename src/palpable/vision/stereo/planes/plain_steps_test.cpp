// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plain_steps.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 60, kHeight = 50, kEdge = 30;

/// A plain wall at 4 px, and right of or below kEdge a bright board at 8 px that reaches `beyond_px` into it.
struct WallBesideBoard {
  ColourPlanes colour;
  Raster<float> disparity_px{kWidth, kHeight};

  WallBesideBoard(int beyond_px, bool below) {
    Raster<std::uint8_t> plane(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const int along = below ? y : x;
        plane(x, y) = along < kEdge ? 60 : 180;
        disparity_px(x, y) = along < kEdge - beyond_px ? 4.0F : 8.0F;
      }
    colour = {plane, plane, plane};
  }
};

TEST(PlainSteps, MoveToTheColourEdgeAlongRowsAndColumns) {
  for (const bool below : {false, true}) {
    WallBesideBoard scene(7, below);
    move_steps_in_plain_surfaces(scene.colour, {}, scene.disparity_px, {});
    EXPECT_EQ(scene.disparity_px, WallBesideBoard(0, below).disparity_px) << below;
  }
}

TEST(PlainSteps, StayWhereTheBandIsNotOfTheSurfaceBeyondTheEdge) {
  WallBesideBoard scene(7, false);
  for (int y = 0; y < kHeight; ++y)
    for (int x = kEdge - 7; x < kEdge; ++x)
      scene.disparity_px(x, y) = 6.0F;  // an object of the wall's colour
  const Raster<float> before = scene.disparity_px;
  move_steps_in_plain_surfaces(scene.colour, {}, scene.disparity_px, {});
  EXPECT_EQ(scene.disparity_px, before);
}

TEST(PlainSteps, StayFarFromTheEdgeAndInTexture) {
  WallBesideBoard far(20, false), textured(7, false);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kEdge; x += 2) textured.colour.r(x, y) = 90;
  for (WallBesideBoard* scene : {&far, &textured}) {
    const Raster<float> before = scene->disparity_px;
    move_steps_in_plain_surfaces(scene->colour, {}, scene->disparity_px, {});
    EXPECT_EQ(scene->disparity_px, before);
  }
}

TEST(PlainSteps, PixelsOfAnotherColourThanTheSurfaceAreKept) {
  WallBesideBoard scene(7, false);
  for (int y = 0; y < kHeight; ++y)  // mixed pixels
    for (auto* plane : {&scene.colour.r, &scene.colour.g, &scene.colour.b}) (*plane)(kEdge - 1, y) = 120;
  move_steps_in_plain_surfaces(scene.colour, {}, scene.disparity_px, {});
  EXPECT_EQ(scene.disparity_px(kEdge - 2, 20), 4.0F);
  EXPECT_EQ(scene.disparity_px(kEdge - 1, 20), 8.0F);
}

}  // namespace
}  // namespace palpable::vision
