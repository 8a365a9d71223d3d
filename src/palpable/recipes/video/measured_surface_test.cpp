// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/measured_surface.hpp"

#include "palpable/recipes/video/seen_house.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

TEST(MeasuredSurface, LiesOnTheHouseFacesTheCameraAndIsCutAtDepthSteps) {
  const auto maps = maps_of_house(1, 0.0);
  VideoModel model;
  model.raised_above = 0.01;
  const Mesh surface = measured_surface(maps.front(), model, {});
  ASSERT_GT(surface.triangles.size(), 300U);
  const Vec3 eye = maps.front().map.pose.translation_m;
  for (const auto& t : surface.triangles) {
    const Vec3 a = surface.vertices_m[t[0]], b = surface.vertices_m[t[1]], c = surface.vertices_m[t[2]];
    const Vec3 middle = (a + b + c) / 3.0;
    EXPECT_GT(dot(cross(b - a, c - a), eye - middle), 0.0);
    // No triangle spans the step from the ridge to the table behind the house: its middle would be in the
    // air. Corners are 16 mm apart.
    EXPECT_LT(std::min(std::abs(outside_house(middle)), std::abs(middle.z)), 0.012);
    EXPECT_GT(std::max({a.z, b.z, c.z}), model.raised_above);
  }
}

}  // namespace
}  // namespace palpable::recipes
