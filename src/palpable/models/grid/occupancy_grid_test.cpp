// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/grid/occupancy_grid.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

/// A ball of radius 10 mm around the origin, points at 1 mm spacing.
Occupancy ball() {
  Occupancy o;
  o.counts = {25, 25, 25};
  o.spacing_m = 0.001;
  o.origin_m = {-0.012, -0.012, -0.012};
  for (int z = 0; z < 25; ++z)
    for (int y = 0; y < 25; ++y)
      for (int x = 0; x < 25; ++x)
        o.occupied.push_back((x - 12) * (x - 12) + (y - 12) * (y - 12) + (z - 12) * (z - 12) <= 100 ? 1 : 0);
  return o;
}

OccupancyGrid grid_of(const Occupancy& o) {
  auto made = OccupancyGrid::from(o, Work{});
  EXPECT_TRUE(made.has_value());
  return *std::move(made);
}

TEST(OccupancyGrid, MeasuresDepthAndNormalWithinItsSpacing) {
  const OccupancyGrid grid = grid_of(ball());
  for (int k = 0; k < 200; ++k) {
    const double a = 0.7 * k, b = std::acos(1.0 - 2.0 * (k + 0.5) / 200);
    const Vec3 out{std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b)};
    for (const double depth_m : {0.002, 0.004, 0.007}) {
      const GridSample s = grid.sample({(0.0103 - depth_m) * out});
      EXPECT_NEAR(s.depth_m, depth_m, 0.001);
      EXPECT_GT(dot(s.normal.v, out), depth_m < 0.005 ? 0.8 : 0.7);
    }
    EXPECT_LT(grid.sample({0.0115 * out}).depth_m, 0.0);
  }
  EXPECT_LT(grid.sample({{0.5, 0.0, 0.0}}).depth_m, 0.0);
}

TEST(OccupancyGrid, IsContinuous) {
  const OccupancyGrid grid = grid_of(ball());
  GridSample last = grid.sample({{-0.014, 0.0013, 0.0007}});
  for (int k = 1; k < 28000; ++k) {
    const GridSample here = grid.sample({{-0.014 + 1e-6 * k, 0.0013, 0.0007}});
    EXPECT_LE(std::abs(here.depth_m - last.depth_m), 2.1e-6);
    last = here;
  }
}

TEST(OccupancyGrid, HasANormalForEveryPatternOfNeighbours) {
  EXPECT_EQ(neighbour_normal(0), Vec3{});
  EXPECT_EQ(neighbour_normal(255), Vec3{});
  // The four lower corners occupied: up.
  EXPECT_NEAR(neighbour_normal(0x0F).z, 1.0, 1e-15);
  // One corner: away from it.
  EXPECT_NEAR(neighbour_normal(1).x, std::sqrt(1.0 / 3.0), 1e-15);
  // The opposite pattern points the other way.
  for (unsigned mask = 0; mask < 256; ++mask)
    EXPECT_NEAR(norm(neighbour_normal(mask) + neighbour_normal(255 - mask)), 0.0, 1e-15);
}

TEST(OccupancyGrid, ReturnsItsOccupancy) {
  const Occupancy o = ball();
  const OccupancyGrid grid = grid_of(o);
  EXPECT_EQ(grid.occupancy().occupied, o.occupied);
  EXPECT_EQ(grid.occupied_points(), 4169U);
  EXPECT_FALSE(grid.occupied(-1, 0, 0));
}

TEST(OccupancyGrid, StoresOnlyBlocksNearOccupiedPoints) {
  Occupancy o;
  o.counts = {100, 100, 50};
  o.spacing_m = 0.0005;
  o.occupied.assign(500'000, 0);
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x) o.occupied[o.index(x, y, z)] = 1;
  EXPECT_LT(grid_of(o).memory_bytes(), 1'200'000U);
}

TEST(OccupancyGrid, RefusesInvalidGrids) {
  Occupancy o = ball();
  o.occupied.pop_back();
  EXPECT_FALSE(OccupancyGrid::from(o, Work{}));
  o = ball();
  o.spacing_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(OccupancyGrid::from(o, Work{}));
  o = ball();
  o.occupied.assign(o.occupied.size(), 0);
  EXPECT_FALSE(OccupancyGrid::from(o, Work{}));
  o.counts = {100'000, 100'000, 100'000};
  EXPECT_FALSE(OccupancyGrid::from(o, Work{}));
}

}  // namespace
}  // namespace palpable::models
