// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/array_shape.hpp"

#include "palpable/hearing/test_arrays.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::hearing {
namespace {

TEST(ArrayShape, IsTheDirectionsThatTheMicrophonesTellApart) {
  EXPECT_EQ(geometry_of(kLevelArray)->shape, ArrayShape::level);
  EXPECT_LT(geometry_of(kLevelArray)->normal.y, -0.99) << "the upper side";
  EXPECT_NEAR(geometry_of(kLevelArray)->aperture_m, 0.2, 1e-12);
  const Microphones upright{{{{0.1, 0, 0}}, {{-0.1, 0, 0}}, {{0, 0.1, 0}}}};
  EXPECT_EQ(geometry_of(upright)->shape, ArrayShape::upright);
  EXPECT_GT(geometry_of(upright)->normal.z, 0.99) << "the side ahead";
  Microphones spatial = kLevelArray;
  spatial.positions_m.push_back({{0, 0.1, 0}});
  EXPECT_EQ(geometry_of(spatial)->shape, ArrayShape::spatial);
}

TEST(ArrayShape, ArraysWithoutADirectionAreRefused) {
  EXPECT_FALSE(geometry_of({}));
  EXPECT_FALSE(geometry_of({{{{0, 0, 0}}, {{0.1, 0, 0}}}})) << "two";
  EXPECT_FALSE(geometry_of({{{{0, 0, 0}}, {{0.1, 0, 0}}, {{0.2, 0, 0}}}})) << "on a line";
  EXPECT_FALSE(geometry_of({{{{0, 0, 0}}, {{0, 0.1, 0}}, {{0, 0, 0.1}}}})) << "left and right alike";
  EXPECT_FALSE(geometry_of({{{{0, 0, 0}}, {{0, 0, 0}}, {{0, 0, 0.1}}, {{0.1, 0, 0}}}})) << "at one place";
  EXPECT_FALSE(geometry_of({{{{0, 0, 0}}, {{4, 0, 0}}, {{0, 0, 0.1}}}})) << "too wide";
  EXPECT_FALSE(geometry_of({{{{0, 0, 0}}, {{0, 0, NAN}}, {{0, 0, 0.1}}}}));
  Microphones still = kLevelArray;
  still.speed_of_sound_m_per_s = 0.0;
  EXPECT_FALSE(geometry_of(still));
}

TEST(Bearing, IsFromAheadToTheRightAndUp) {
  EXPECT_NEAR(bearing_of({{1, 0, 1}}, ArrayShape::spatial).azimuth_deg, 45.0, 1e-9);
  EXPECT_NEAR(bearing_of({{-1, 0, 0}}, ArrayShape::level).azimuth_deg, -90.0, 1e-9);
  EXPECT_FALSE(bearing_of({{-1, 0, 0}}, ArrayShape::level).elevation_deg);
  EXPECT_NEAR(*bearing_of({{0, -1, 1}}, ArrayShape::upright).elevation_deg, 45.0, 1e-9);
  const auto there = bearing_of(direction_at(-130.0, 20.0), ArrayShape::spatial);
  EXPECT_NEAR(there.azimuth_deg, -130.0, 1e-9);
  EXPECT_NEAR(*there.elevation_deg, 20.0, 1e-9);
}

}  // namespace
}  // namespace palpable::hearing
