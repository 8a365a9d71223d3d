// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/path_heights.hpp"

#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

Relief rough_relief(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0F, 0.008F);
  Raster<float> z(24, 17);
  for (float& height : z.values()) height = unit(random);
  return *Relief::from_samples(std::move(z), 0.0005);
}

/// Random paths, of which some begin and end beyond the relief's border.
struct Paths {
  explicit Paths(const Relief& relief) : wide_m(relief.size_x_m()), high_m(relief.highest_m()) {}
  Vec3 place() {
    std::uniform_real_distribution<double> unit(-0.7, 0.7);
    return {wide_m * unit(random), wide_m * unit(random), high_m * (unit(random) + 0.7)};
  }
  double wide_m;
  double high_m;
  std::mt19937 random{5};
};

double value_at(const PathHeights& heights, double share) {
  auto row = heights.coefficients();
  for (std::size_t n = PathHeights::kCount - 1; n > 0; --n)
    for (std::size_t k = 0; k < n; ++k) row[k] += static_cast<float>(share) * (row[k + 1] - row[k]);
  return double{row[0]};
}

TEST(PathHeights, AreTheHeightsOverTheSurfaceInEveryCellOfAPath) {
  const Relief relief = rough_relief(3);
  Paths paths(relief);
  for (int n = 0; n < 200; ++n) {
    const Vec3 from = paths.place();
    const Vec3 way = paths.place() - from;
    CellWalk walk = relief.cell_walk(from, from + way);
    int cells = 0;
    for (double begin = 0.0; begin < 1.0; ++cells) {
      const double end = walk.next();
      ASSERT_GE(end, begin);
      const PathHeights heights = relief.path_in_cell(from + begin * way, from + end * way).heights();
      for (int k = 0; k <= 8; ++k) {
        const Vec3 p = from + (begin + k / 8.0 * (end - begin)) * way;
        ASSERT_NEAR(value_at(heights, k / 8.0), p.z - relief.sample(p.x, p.y).z_m, 2e-8);
        ASSERT_GE(p.z - relief.sample(p.x, p.y).z_m, double{heights.lowest()} - 1e-7);
      }
      begin = end;
    }
    ASSERT_LE(cells, 3 + static_cast<int>((std::abs(way.x) + std::abs(way.y)) / relief.pixel_m()));
  }
}

TEST(PathHeights, FindTheFirstEntryAndMissNoneThatIsDeeper) {
  constexpr float kIgnored_m = 1e-6F;
  const Relief relief = rough_relief(4);
  Paths paths(relief);
  int found = 0;
  int grazed = 0;
  for (int n = 0; n < 4000; ++n) {
    // Within one cell; every second path touches its lowest place over the surface.
    const Vec3 corner = paths.place();
    Vec3 from{std::floor(corner.x / 0.0005) * 0.0005 + 1e-5, std::floor(corner.y / 0.0005) * 0.0005 + 1e-5,
              0.0};
    if (n % 2 == 0) from.z = corner.z;
    Vec3 to = from + Vec3{0.0002, (n % 7) * 3e-5, 0.0};
    const auto lowest_over = [&](int places) {
      double lowest_m = 1.0;
      for (int k = 0; k <= places; ++k) {
        const Vec3 p = from + (1.0 * k / places) * (to - from);
        lowest_m = std::min(lowest_m, p.z - relief.sample(p.x, p.y).z_m);
      }
      return lowest_m;
    };
    if (n % 2 == 1) from.z = to.z = -lowest_over(1000) + (n % 4 == 1 ? -3e-6 : 1e-7);
    if (from.z <= relief.sample(from.x, from.y).z_m) continue;
    const double lowest_m = lowest_over(1000);
    const PathEntry entry = relief.path_in_cell(from, to).heights().entry(kIgnored_m);
    if (lowest_m > 0.0 || lowest_m < -2e-6) {
      EXPECT_EQ(entry.is_found, lowest_m < 0.0) << lowest_m;
    }
    if (!entry.is_found) continue;
    ++found;
    grazed += lowest_m > -5e-6 ? 1 : 0;
    EXPECT_GE(entry.above_m, -1e-8 - double{kIgnored_m});
    EXPECT_LT(entry.below_m, 0.0);
    // Nothing is cut before it.
    for (int k = 0; k <= 100; ++k) {
      const Vec3 p = from + (k / 100.0 * entry.part.from) * (to - from);
      ASSERT_GE(p.z - relief.sample(p.x, p.y).z_m, -2e-6);
    }
  }
  EXPECT_GT(found, 400);
  EXPECT_GT(grazed, 100);
}

}  // namespace
}  // namespace palpable::models
