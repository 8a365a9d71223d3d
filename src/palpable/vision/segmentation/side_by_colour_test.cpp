// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/side_by_colour.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr Rgb8 kRedSide{200, 40, 30};
constexpr Rgb8 kGreen{40, 180, 60};

/// Red up to column 60, green from there on; the known pixels end before that.
struct TwoSides {
  Raster<Rgb8> picture{120, 60};
  Raster<Side> side{120, 60};
  TwoSides(int sure_until, int sure_from, Side between) {
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 120; ++x) {
        picture(x, y) = x < 60 ? kRedSide : kGreen;
        side(x, y) = x < sure_until ? Side::inside : x >= sure_from ? Side::outside : between;
      }
  }
  void expect_border_at_60() const {
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 120; ++x)
        ASSERT_EQ(side(x, y), x < 60 ? Side::inside : Side::outside) << x << ", " << y;
  }
};

TEST(DecideByColour, PutsTheBorderWhereThePictureHasIt) {
  for (const Side between : {Side::unknown, Side::perhaps_inside, Side::perhaps_outside}) {
    TwoSides scene(50, 75, between);
    decide_by_colour(scene.picture, scene.side, Work{});
    scene.expect_border_at_60();
  }
}

TEST(DecideByColour, ReachesPixelsFarFromDecidedOnes) {
  TwoSides scene(6, 118, Side::unknown);
  decide_by_colour(scene.picture, scene.side, Work{});
  for (int y = 0; y < 60; ++y) {
    EXPECT_EQ(scene.side(50, y), Side::inside);
    EXPECT_EQ(scene.side(70, y), Side::outside);
  }
}

TEST(DecideByColour, KeepsThePriorIfColourDoesNotDecide) {
  for (const Side between : {Side::perhaps_inside, Side::perhaps_outside}) {
    TwoSides scene(50, 75, between);
    for (Rgb8& pixel : scene.picture.values()) pixel = kRedSide;
    decide_by_colour(scene.picture, scene.side, Work{});
    EXPECT_EQ(scene.side(65, 30), between == Side::perhaps_inside ? Side::inside : Side::outside);
  }
}

TEST(DecideByColour, KeepsPixelsUnknownIfNothingIsDecided) {
  TwoSides scene(0, 120, Side::unknown);
  decide_by_colour(scene.picture, scene.side, Work{});
  for (const Side side : scene.side.values()) EXPECT_EQ(side, Side::unknown);
}

}  // namespace
}  // namespace palpable::vision
