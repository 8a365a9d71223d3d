// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/segment.hpp"

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/vec3.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(Segment, IsNearestBesideItOrAtAnEnd) {
  const MapPoint a{1.0, 1.0}, b{5.0, 4.0};
  EXPECT_DOUBLE_EQ(nearest_share(MapPoint{-2.0, 0.0}, a, b), 0.0);
  EXPECT_DOUBLE_EQ(nearest_share(MapPoint{9.0, 9.0}, a, b), 1.0);
  // The middle, and a point 2.5 beside it.
  EXPECT_DOUBLE_EQ(nearest_share(MapPoint{3.0 - 1.5, 2.5 + 2.0}, a, b), 0.5);
  EXPECT_DOUBLE_EQ(distance_to_segment(MapPoint{3.0 - 1.5, 2.5 + 2.0}, a, b), 2.5);
  EXPECT_DOUBLE_EQ(distance_to_segment(MapPoint{1.0, -1.0}, a, b), 2.0);
}

TEST(Segment, OfOnePointHasTheDistanceOfThatPoint) {
  EXPECT_DOUBLE_EQ(nearest_share(Vec3{3.0, 4.0, 0.0}, Vec3{}, Vec3{}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to_segment(Vec3{3.0, 4.0, 0.0}, Vec3{}, Vec3{}), 5.0);
}

}  // namespace
}  // namespace palpable
