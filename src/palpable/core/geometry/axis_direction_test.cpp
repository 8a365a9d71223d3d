// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/axis_direction.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(AxisDirection, IsFoundByItsName) {
  for (const AxisDirection direction : kAxisDirections)
    EXPECT_EQ(axis_direction_from(name_of(direction)), direction);
  EXPECT_FALSE(axis_direction_from("up"));
}

TEST(AxisDirection, IsTheNearestToItsOwnVector) {
  for (const AxisDirection direction : kAxisDirections)
    EXPECT_EQ(nearest_axis_direction(3.0 * unit_vector(direction) + Vec3{0.1, -0.2, 0.3}), direction);
}

}  // namespace
}  // namespace palpable
