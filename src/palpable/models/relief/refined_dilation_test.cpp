// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/refined_dilation.hpp"

#include "palpable/models/relief/relief_dilation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

using Heights = std::function<double(double x_m, double y_m)>;

Relief relief_over(int width, int height, double pixel_m, const Heights& z) {
  Raster<float> values(width, height);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      values(i, j) =
          static_cast<float>(z((i - 0.5 * (width - 1)) * pixel_m, (0.5 * (height - 1) - j) * pixel_m));
  return *Relief::from_samples(std::move(values), pixel_m);
}

/// Greatest distance along the normal between the dilated relief and the true position of the ball over walls
/// of this slope, over `within_m` around the middle.
double worst_error(const RefinedRelief& dilated, const Heights& truth, double slope, double within_m,
                   unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-within_m, within_m);
  double worst_m = 0.0;
  for (int k = 0; k < 20000; ++k) {
    // Half of the places are close to the middle, where the creases are.
    const double share = k % 2 == 0 ? 1.0 : 0.05;
    const double x = share * place(random);
    const double y = place(random);
    worst_m = std::max(worst_m, std::abs(dilated.sample(x, y).z_m - truth(x, y)));
  }
  return worst_m / std::sqrt(1.0 + slope * slope);
}

TEST(DilateFinely, RepresentsGroovesOfAnyDirectionWithinFiveMicrometres) {
  for (const double pixel_m : {0.0001, 0.00015625, 0.0003})
    for (const double radius_m : {0.0005, 0.001, 0.002})
      for (const double slope : {0.5, 1.0, 2.0, 3.0})
        for (const double turned : {0.0, 0.3, 0.25 * std::numbers::pi}) {
          const double shifted_m = 0.37 * pixel_m;
          const auto groove = [&](double x, double y) {
            return slope * std::abs(std::cos(turned) * x + std::sin(turned) * y - shifted_m);
          };
          const double over_m = radius_m * std::sqrt(1.0 + slope * slope);
          const Relief relief = relief_over(80, 60, pixel_m, groove);
          const auto dilated = dilate_finely_by_ball(relief, radius_m, {});
          // Only where the ball touches the slopes inside the relief.
          const double within_m = 0.68 * (30 * pixel_m - radius_m);
          // A relief rounds the bottom of a groove over two pixels; the ball must touch beside that.
          const double contact_m = radius_m * slope / std::sqrt(1.0 + slope * slope);
          if (within_m < 4.0 * pixel_m || contact_m < 3.0 * pixel_m) continue;
          EXPECT_LE(
              worst_error(
                  *dilated, [&](double x, double y) { return groove(x, y) + over_m; }, slope, within_m, 1),
              5e-6)
              << pixel_m << " " << radius_m << " " << slope << " " << turned;
        }
}

TEST(DilateFinely, RepresentsPitsOfConesWithinFiveMicrometres) {
  for (const double radius_m : {0.001, 0.002})
    for (const double slope : {0.7, 1.0, 2.0, 3.0}) {
      const auto pit = [&](double x, double y) { return slope * std::hypot(x, y); };
      const double over_m = radius_m * std::sqrt(1.0 + slope * slope);
      const auto dilated = dilate_finely_by_ball(relief_over(120, 120, 0.00015625, pit), radius_m, {});
      EXPECT_LE(worst_error(
                    *dilated, [&](double x, double y) { return pit(x, y) + over_m; }, slope, 0.005, 2),
                5e-6)
          << radius_m << " " << slope;
    }
}

/// The Minkowski sum of a relief and a ball by trying contacts everywhere, on a grid that is refined around
/// its best place.
double sum_by_search(const Relief& relief, double radius_m, double x_m, double y_m) {
  double best_m = -1.0;
  double at_x = 0.0;
  double at_y = 0.0;
  double half_m = radius_m;
  for (int pass = 0; pass < 5; ++pass) {
    constexpr int kSide = 60;
    const double middle_x = at_x;
    const double middle_y = at_y;
    for (int j = -kSide; j <= kSide; ++j)
      for (int i = -kSide; i <= kSide; ++i) {
        const double dx = middle_x + i * half_m / kSide;
        const double dy = middle_y + j * half_m / kSide;
        const double over2 = radius_m * radius_m - dx * dx - dy * dy;
        if (over2 < 0.0) continue;
        const double height_m = relief.sample(x_m + dx, y_m + dy).z_m + std::sqrt(over2);
        if (height_m <= best_m) continue;
        best_m = height_m;
        at_x = dx;
        at_y = dy;
      }
    half_m *= 4.0 / kSide;
  }
  return best_m;
}

TEST(DilateFinely, IsTheMinkowskiSumOnSpheresConesAndWavesWithinFiveMicrometres) {
  constexpr double kPixel_m = 0.00015625;
  const std::vector<Heights> shapes{
      [](double x, double y) { return std::sqrt(std::max(0.0, 25e-6 - x * x - y * y)) * 0.9; },
      [](double x, double y) { return -0.95 * std::sqrt(std::max(0.0, 36e-6 - x * x - y * y)); },
      [](double x, double y) { return std::max(0.0, 0.004 - 1.5 * std::hypot(x, y)); },
      [](double x, double y) { return 0.001 * std::sin(x / 0.001) * std::cos(y / 0.0013); },
      [](double x, double y) { return 0.002 * std::abs(std::sin(x / 0.0015 + y / 0.004)); }};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.0035, 0.0035);
  for (std::size_t k = 0; k < shapes.size(); ++k)
    for (const double radius_m : {0.0005, 0.001}) {
      const Relief relief = relief_over(100, 100, kPixel_m, shapes[k]);
      const auto dilated = dilate_finely_by_ball(relief, radius_m, {});
      double worst_m = 0.0;
      for (int n = 0; n < 60; ++n) {
        const double x = place(random);
        const double y = place(random);
        const HeightSample s = dilated->sample(x, y);
        if (std::hypot(s.dzdx, s.dzdy) > 3.0) continue;
        worst_m = std::max(worst_m, std::abs(s.z_m - sum_by_search(relief, radius_m, x, y)) /
                                        std::sqrt(1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy));
      }
      EXPECT_LE(worst_m, 5e-6) << k << " " << radius_m;
    }
}

Relief rough(int width, int height, double pixel_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.7 * pixel_m);
  return relief_over(width, height, pixel_m,
                     [&](double x, double) { return 0.3 * std::abs(x) + noise(random); });
}

TEST(DilateFinely, IsContinuousUpToItsCurvature) {
  const auto dilated = dilate_finely_by_ball(rough(60, 50, 0.0002, 3), 0.001, {});
  ASSERT_GT(dilated->cells().cells.size(), 100U);
  ASSERT_LT(dilated->cells().cells.size(), 58U * 48U);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> along(-0.0045, 0.0045);
  for (int k = 0; k < 20000; ++k) {
    // Just left and right of a border between cells.
    const double x = (std::floor(along(random) / 0.0002) + 0.5) * 0.0002;
    const double y = along(random);
    const CurvedSample a = dilated->curved_sample(x - 1e-10, y);
    const CurvedSample b = dilated->curved_sample(x + 1e-10, y);
    ASSERT_NEAR(a.z_m, b.z_m, 2e-9);
    ASSERT_NEAR(a.dzdx, b.dzdx, 1e-3);
    ASSERT_NEAR(a.dzdy, b.dzdy, 1e-3);
    // Single precision of heights of millimetres leaves 1e-9 m, over the square of a fine pixel.
    ASSERT_NEAR(a.dzdxx_per_m, b.dzdxx_per_m, 100.0);
    ASSERT_NEAR(a.dzdyy_per_m, b.dzdyy_per_m, 100.0);
  }
}

TEST(DilateFinely, HasTheGradientAndTheBoundsOfItsHeights) {
  const auto dilated = dilate_finely_by_ball(rough(60, 50, 0.0002, 6), 0.0008, {});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.007, 0.007);
  for (int k = 0; k < 20000; ++k) {
    const double x = place(random);
    const double y = place(random);
    const CurvedSample s = dilated->curved_sample(x, y);
    constexpr double kStep_m = 3e-7;
    ASSERT_NEAR(s.dzdx,
                (dilated->sample(x + kStep_m, y).z_m - dilated->sample(x - kStep_m, y).z_m) / (2 * kStep_m),
                0.01);
    ASSERT_NEAR(s.dzdy,
                (dilated->sample(x, y + kStep_m).z_m - dilated->sample(x, y - kStep_m).z_m) / (2 * kStep_m),
                0.01);
    const SurfaceBounds bounds = dilated->bounds_over(x, y, x + 0.1 * place(random), y + 0.1 * place(random));
    ASSERT_LE(s.z_m, bounds.highest + 1e-9);
    ASSERT_LE(std::hypot(s.dzdx, s.dzdy), bounds.steepest + 1e-4);
    ASSERT_LE(std::hypot(s.dzdx, s.dzdy), dilated->steepest_slope() + 1e-4);
  }
}

TEST(DilateFinely, LeavesLevelAndSlopingGroundAsItIs) {
  const Relief slope = relief_over(80, 60, 0.00015625, [](double x, double y) { return 1.5 * x - 0.8 * y; });
  const auto dilated = dilate_finely_by_ball(slope, 0.001, {});
  for (const ReliefCells::Cell cell : dilated->cells().cells)
    EXPECT_TRUE(cell.x < 12 || cell.x > 66 || cell.y < 12 || cell.y > 46) << cell.x << " " << cell.y;
  const Relief coarse = *Relief::from_samples(dilate_by_ball(slope, 0.001, {}), slope.pixel_m());
  EXPECT_EQ(dilated->sample(0.0011, -0.0007).z_m, coarse.sample(0.0011, -0.0007).z_m);
}

TEST(DilateFinely, LeavesReliefsWithCreasesEverywhereUnrefined) {
  const Relief everywhere = rough(120, 100, 0.0002, 8);
  const auto dilated = dilate_finely_by_ball(everywhere, 0.001, {});
  EXPECT_TRUE(dilated->cells().cells.empty());
  const Relief coarse = *Relief::from_samples(dilate_by_ball(everywhere, 0.001, {}), everywhere.pixel_m());
  EXPECT_EQ(dilated->sample(0.0011, -0.0007).z_m, coarse.sample(0.0011, -0.0007).z_m);
}

TEST(DilateFinely, TakesTheSmallestReliefs) {
  for (const int side : {2, 3, 4}) {
    const auto dilated = dilate_finely_by_ball(
        relief_over(side, side, 0.001, [](double x, double) { return std::abs(x); }), 0.002, {});
    EXPECT_TRUE(std::isfinite(dilated->sample(0.0001, 0.0002).z_m)) << side;
    EXPECT_GE(dilated->sample(0.0, 0.0).z_m, 0.002) << side;
  }
}

}  // namespace
}  // namespace palpable::models
