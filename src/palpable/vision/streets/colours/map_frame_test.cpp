// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/colours/map_frame.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kSide = 300;

/// A map of 200 x 160 pixels with white streets on a page, turned about the middle.
Raster<Rgb8> map_on_page(double turn_deg, Rgb8 page) {
  Raster<Rgb8> out(kSide, kSide, page);
  const double c = std::cos(turn_deg * M_PI / 180.0);
  const double s = std::sin(turn_deg * M_PI / 180.0);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double u = c * (x - 150) + s * (y - 150);
      const double v = -s * (x - 150) + c * (y - 150);
      if (std::abs(u) > 100.0 || std::abs(v) > 80.0) continue;
      const bool is_street = std::abs(u - 20.0) < 5.0 || std::abs(v + 10.0) < 5.0;
      out(x, y) = is_street ? Rgb8{255, 255, 255} : Rgb8{230, 225, 215};
    }
  return out;
}

TEST(MapFrame, IsFoundOnAPageInAnyDirection) {
  for (const double turn_deg : {0.0, 7.0, 30.0, 80.0}) {
    const MapFrame frame = find_map_frame(map_on_page(turn_deg, {255, 255, 255}));
    ASSERT_TRUE(frame.on_page) << turn_deg;
    // Half the diagonal of the map, less the inset.
    for (const MapPoint c : frame.corners)
      EXPECT_NEAR(std::hypot(c.x - 150, c.y - 150), std::hypot(98.0, 78.0), 2.0) << turn_deg;
    EXPECT_NEAR(distance_to_side(frame, {150, 150}), 78.0, 1.5);
    const double a = turn_deg * M_PI / 180.0;
    EXPECT_NEAR(distance_to_side(frame, {150, 150}, {std::cos(a), std::sin(a)}), 98.0, 1.5);
  }
}

TEST(MapFrame, IsThePictureWithoutAPage) {
  // Land at all corners is not a page: its streets go on to the border, and the map has no straight sides.
  Raster<Rgb8> land(kSide, kSide, {230, 225, 215});
  for (int i = 0; i < kSide; ++i)
    for (int k = -4; k <= 4; ++k) land(i, 150 + k) = land(150 + k, i) = {255, 255, 255};
  for (const Raster<Rgb8>& picture :
       {land, Raster<Rgb8>(kSide, kSide, {255, 255, 255}), Raster<Rgb8>(2, 2)}) {
    const MapFrame frame = find_map_frame(picture);
    EXPECT_FALSE(frame.on_page);
    EXPECT_EQ(frame.corners[2].x, picture.width() - 1);
  }
}

}  // namespace
}  // namespace palpable::vision
