// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_solid.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

Relief waves(int width, int height) {
  Raster<float> z(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      z(x, y) = static_cast<float>(0.004 + 0.003 * std::sin(0.4 * x) * std::cos(0.3 * y));
  return *Relief::from_samples(std::move(z), 0.0005);
}

TEST(SolidOf, IsWatertightWithTheRightSizeAndVolume) {
  for (const auto& [w, h] : {std::pair{2, 2}, {40, 30}, {7, 3}}) {
    const Relief relief = waves(w, h);
    const Mesh solid = solid_of(relief);
    EXPECT_TRUE(is_watertight(solid));
    Vec3 low = solid.vertices_m.front();
    Vec3 high = low;
    for (const Vec3 v : solid.vertices_m) {
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    EXPECT_NEAR(high.x - low.x, relief.size_x_m(), 1e-12);
    EXPECT_NEAR(high.y - low.y, relief.size_y_m(), 1e-12);
    EXPECT_NEAR(low.z, -0.002, 1e-12);
    EXPECT_LE(high.z, relief.highest_m());
    double six_volumes = 0.0;
    for (const auto& t : solid.triangles)
      six_volumes += dot(solid.vertices_m[t[0]], cross(solid.vertices_m[t[1]], solid.vertices_m[t[2]]));
    double mean = 0.0;
    for (const Vec3 v : solid.vertices_m) mean = std::max(mean, v.z);
    EXPECT_GT(six_volumes, 0.0) << "its faces are oriented outwards";
    EXPECT_LT(six_volumes / 6.0, relief.size_x_m() * relief.size_y_m() * (mean + 0.002));
  }
}

TEST(IsWatertight, DetectsAHoleAndAReversedFace) {
  Mesh solid = solid_of(waves(5, 4));
  Mesh holed = solid;
  holed.triangles.pop_back();
  EXPECT_FALSE(is_watertight(holed));
  std::swap(solid.triangles[3][0], solid.triangles[3][1]);
  EXPECT_FALSE(is_watertight(solid));
  EXPECT_FALSE(is_watertight({}));
}

}  // namespace
}  // namespace palpable::models
