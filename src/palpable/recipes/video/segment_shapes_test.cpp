// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/segment_shapes.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

TEST(SegmentShapes, HaveThePlaceAndSizeOfTheirSegmentAcrossTheLineOfSight) {
  // A red rectangle of 40 x 20 pixels on a green ground, at a distance of 2 with a focal length of 100 px.
  Raster<Rgb8> picture(120, 90, Rgb8{40, 160, 50});
  for (int y = 30; y < 50; ++y)
    for (int x = 50; x < 90; ++x) picture(x, y) = {200, 30, 30};
  vision::FrameDepth map;
  map.map.depth = {Raster<float>(120, 90, 2.0F), Pinhole{100, 100, 59.5, 44.5, 120, 90}};
  const auto shapes = shapes_of_segments(picture, map, {}, {});
  ASSERT_TRUE(shapes) << shapes.error().sentence();
  ASSERT_EQ(shapes->size(), 1U);
  const models::Superquadric& shape = shapes->front();
  const Vec3 at = shape.scene_from_shape.translation_m;
  EXPECT_NEAR(at.x, (69.5 - 59.5) / 100 * 2, 0.03);
  EXPECT_NEAR(at.y, (39.5 - 44.5) / 100 * 2, 0.03);
  EXPECT_NEAR(at.z, 2.0, 1e-9);
  EXPECT_NEAR(shape.size_m.x, 0.4, 0.06);
  EXPECT_NEAR(shape.size_m.y, 0.2, 0.04);
  EXPECT_NEAR(shape.size_m.z, 0.3, 0.05);
}

}  // namespace
}  // namespace palpable::recipes
