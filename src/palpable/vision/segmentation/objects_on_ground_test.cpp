// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/background.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A table whose far edge is row 40, a wall behind it, a tall box that hides both, and a low one.
struct BoxOnGround {
  Ground ground{{0.0, 0.1, 10.0}, Raster<std::uint8_t>(160, 120), 0.0, 0.1};
  Raster<float> disparity_px{160, 120};
  BoxOnGround() {
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 160; ++x) {
        const bool tall = x >= 30 && x < 60 && y >= 10 && y < 90,
                   low = x >= 90 && x < 120 && y >= 70 && y < 85;
        const double d = tall  ? ground.plane.at(0, 90)
                         : low ? ground.plane.at(x, y) + 1.0
                               : ground.plane.at(0, std::max(y, 40));
        disparity_px(x, y) = static_cast<float>(d);
        ground.mask(x, y) = !tall && !low && y >= 40 ? 255 : 0;
      }
  }
};

TEST(ObjectsOnGround, IncludePartsBeyondTheGroundsEdge) {
  const BoxOnGround scene;
  const auto objects = objects_on_ground(scene.ground, scene.disparity_px);
  EXPECT_EQ(objects(45, 60), 255);
  EXPECT_EQ(objects(45, 15), 255) << "above the table's edge";
  EXPECT_EQ(objects(105, 78), 255) << "the low one";
  EXPECT_EQ(objects(100, 20), 0) << "the wall";
  EXPECT_EQ(objects(100, 100), 0) << "the table";
}

}  // namespace
}  // namespace palpable::vision
