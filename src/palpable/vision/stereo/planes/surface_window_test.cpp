// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/surface_window.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// The weight and rise of the second of two pixels in a row for the first, which lies at 5 px on a slope of
/// 0.5.
struct Pair {
  float disparity = 5.5F;
  std::uint8_t level = 90;
  float own_weight = 1.0F;

  std::array<float, 2> weigh(const FitWindow& window) const {
    const Raster<std::uint8_t> plane(2, 1, 90);
    ColourPlanes colour{plane, plane, plane};
    colour.g(1, 0) = level;
    PlaneMap map(2, 1);
    map.disparity(0, 0) = 5.0F;
    map.slope_x(0, 0) = 0.5F;
    map.disparity(1, 0) = disparity;
    Raster<float> weight(2, 1, own_weight);
    std::array<float, 2> out{};
    const SurfaceWindows windows(colour, map, weight, window, {});
    SurfaceCentres centres;
    SurfaceLanes weights, rises;
    load_centres(windows, 0, 0, centres);
    over_window(windows, 0, 0, [&](const WindowOffset& offset, std::size_t at) {
      if (offset.dx != 1.0F || offset.dy != 0.0F) return;
      vision::weigh(windows, centres, offset, at, weights, rises);
      out = {weights[0], rises[0]};
    });
    return out;
  }
};

TEST(SurfaceWeights, AreOneOnThePlaneAndInTheColourOfTheCentre) {
  const auto [weight, rise] = Pair{}.weigh({});
  EXPECT_EQ(weight, 1.0F);
  EXPECT_EQ(rise, 0.5F);
}

TEST(SurfaceWeights, FallToZeroWithTheDistanceFromThePlane) {
  const FitWindow window{.tolerance_px = 1.0F, .tolerance_per_px = 0.0F};
  EXPECT_NEAR((Pair{.disparity = 5.75F}.weigh(window)[0]), 0.75F, 1e-6F);
  EXPECT_EQ((Pair{.disparity = 6.75F}.weigh(window)[0]), 0.0F);
}

TEST(SurfaceWeights, AreHalfAtTheColourDifferenceOfTheWindow) {
  EXPECT_NEAR((Pair{.level = 102}.weigh({.half_weight_levels = 12.0F})[0]), 0.5F, 1e-6F);
}

TEST(SurfaceWeights, IncludeThePixelsOwnWeight) {
  EXPECT_NEAR((Pair{.own_weight = 0.3F}.weigh({})[0]), 0.3F, 1e-6F);
}

TEST(OverWindow, VisitsEveryOffsetInThePictureAndTheMargin) {
  const Raster<std::uint8_t> plane(5, 5, 90);
  const PlaneMap map(5, 5);
  const Raster<float> weight(5, 5, 1.0F);
  const SurfaceWindows windows({plane, plane, plane}, map, weight, {.radius_px = 2, .step_px = 2}, {});
  int offsets = 0;
  float weights = 0.0F;
  over_window(windows, 0, 0, [&](const WindowOffset& offset, std::size_t at) {
    EXPECT_GE(offset.dy, 0.0F);
    ++offsets;
    weights += windows.weight.data()[at];
  });
  // Rows 0 and 2 of the window, columns -2, 0 and 2; the first is outside the picture.
  EXPECT_EQ(offsets, 2 * 3);
  EXPECT_EQ(weights, 2 * 2);
}

}  // namespace
}  // namespace palpable::vision
