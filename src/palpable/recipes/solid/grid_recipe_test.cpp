// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/grid_recipe.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Two posts of equal width in the picture; the left one is twice as far away. Beside them, above the middle,
/// a distant strip makes the box wide.
DisparityMap two_posts() {
  const int w = 200, h = 150;
  DisparityMap map{Raster<float>(w, h, kUnknown), StereoRig{Pinhole{200, 200, 99.5, 74.5, w, h}, 0.1, 0.0}};
  for (int y = 20; y < 130; ++y) {
    for (int x = 40; x < 80; ++x) map.disparity_px(x, y) = 10.0F;
    for (int x = 120; x < 160; ++x) map.disparity_px(x, y) = 20.0F;
    for (int x = 180; x < 198 && y < 40; ++x) map.disparity_px(x, y) = 10.0F;
  }
  return map;
}

/// Occupied points along x at one height and depth, left and right of the middle.
struct Widths {
  int left = 0;
  int right = 0;
};
Widths widths(const models::OccupancyGrid& grid, int z) {
  Widths widths;
  const auto counts = grid.counts();
  for (int x = 0; x < counts[0]; ++x) {
    const bool on = grid.occupied(x, counts[1] / 2, z);
    const double place_m = grid.origin_m().x + x * grid.spacing_m();
    if (on) ++(place_m < 0.0 ? widths.left : widths.right);
  }
  return widths;
}

TEST(GridFromDisparity, PutsPointsWhereTheCameraSawThemAndFillsAwayFromIt) {
  const auto made = grid_from_disparity(two_posts(), {}, {});
  ASSERT_TRUE(made) << made.error().sentence();
  const auto& grid = std::get<std::shared_ptr<const models::Grid>>(made->scene.model)->occupancy;
  const auto counts = grid.counts();
  // At the depth of the far post, the rays through the near one have spread to the same width; at its own
  // front, it is half as wide as the far one.
  const int far = static_cast<int>(std::lround(-grid.origin_m().z / grid.spacing_m()));
  int near = counts[2] - 1;
  while (near > 0 && widths(grid, near).right == 0) --near;
  EXPECT_GT(widths(grid, far).left, 8);
  EXPECT_NEAR(widths(grid, far).right, widths(grid, far).left, 2);
  EXPECT_NEAR(widths(grid, near).left + widths(grid, near).right, 0.5 * widths(grid, far).left, 2);
  const Vec3 size = models::size_m(made->scene);
  EXPECT_LE(size.x, 0.11);
  EXPECT_LE(size.z, 0.055);
}

TEST(GridFromDisparity, IsSeenFromAboveAsItIsFilled) {
  const auto made = grid_from_disparity(two_posts(), {}, {});
  ASSERT_TRUE(made);
  const auto& model = *std::get<std::shared_ptr<const models::Grid>>(made->scene.model);
  // Where the columns beside it are equally high, the highest point of a column is the height of the relief.
  const auto& above = model.from_above->samples_m();
  int seen = 0;
  for (int x = 1; x + 1 < above.width(); ++x) {
    const int y = above.height() / 2;
    const double height_m = above(x, y);
    if (height_m < 0.01 || above(x - 1, y) != above(x, y) || above(x + 1, y) != above(x, y)) continue;
    ++seen;
    const Vec3 place{model.occupancy.origin_m().x + x * model.occupancy.spacing_m(), 0.0, height_m};
    EXPECT_NEAR(place.x, (x - 0.5 * (above.width() - 1)) * model.from_above->pixel_m(), 1e-9);
    const double spacing_m = model.occupancy.spacing_m();
    EXPECT_GT(model.occupancy.sample({place - Vec3{0.0, 0.0, 2.0 * spacing_m}}).depth_m, 0.0);
    EXPECT_LT(model.occupancy.sample({place + Vec3{0.0, 0.0, 2.0 * spacing_m}}).depth_m, 0.0);
  }
  EXPECT_GT(seen, 5);
}

TEST(GridFromDisparity, AssumesACameraAndSaysSo) {
  DisparityMap map = two_posts();
  map.rig.reset();
  const auto made = grid_from_disparity(map, {}, {});
  ASSERT_TRUE(made);
  ASSERT_FALSE(made->notes.empty());
  EXPECT_EQ(made->notes.front().reason, Reason::needs_calibration);
}

TEST(GridFromDisparity, RefusesAPictureWithoutAKnownPixel) {
  DisparityMap map = two_posts();
  for (float& d : map.disparity_px.values()) d = kUnknown;
  const auto made = grid_from_disparity(map, {}, {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace palpable::recipes
