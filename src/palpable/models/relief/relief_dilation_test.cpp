// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_dilation.hpp"

#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

constexpr double kPixel_m = 0.00015625;

Relief relief_of_heights(int width, int height, double (*z)(double x_m)) {
  Raster<float> values(width, height);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) values(i, j) = static_cast<float>(z((i - 0.5 * (width - 1)) * kPixel_m));
  return *Relief::from_samples(std::move(values), kPixel_m);
}

/// Error of the position of the centre of the ball along the normal, over the middle of the relief.
struct Errors {
  double least_m = 0.0;
  double most_m = 0.0;
};

Errors errors_of(const Relief& relief, double radius_m) {
  const Relief dilated = *Relief::from_samples(dilate_by_ball(relief, radius_m, {}), relief.pixel_m());
  Errors errors;
  for (double x = -0.004; x < 0.004; x += 1.3e-5) {
    double true_m = -1.0;
    for (int k = -3000; k <= 3000; ++k) {
      const double d = k * radius_m / 3000;
      true_m = std::max(true_m, relief.sample(x + d, 0.0).z_m + std::sqrt(radius_m * radius_m - d * d));
    }
    const HeightSample s = dilated.sample(x, 0.0);
    const double off_m = (s.z_m - true_m) / std::sqrt(1.0 + s.dzdx * s.dzdx);
    errors = {std::min(errors.least_m, off_m), std::max(errors.most_m, off_m)};
  }
  return errors;
}

TEST(DilateByBall, RaisesLevelGroundByTheRadius) {
  const auto raised = dilate_by_ball(relief_of_heights(30, 20, [](double) { return 0.004; }), 0.001, {});
  for (const float z : raised.values()) EXPECT_NEAR(z, 0.005, 1e-7);
}

// The time was once proportional to the square of the radius: minutes for a relief of this size.
TEST(DilateByBall, TakesTheLargestBallOnALargeRelief) {
  const auto raised = dilate_by_ball(
      relief_of_heights(1200, 800, [](double x) { return 0.002 * std::sin(2000.0 * x); }), 0.02, {});
  // The ball rests on two crests, 3.1 mm apart; the spline lowers them by a sixth of the second differences.
  float lowest = 1.0F, highest = 0.0F;
  for (int x = 300; x < 900; ++x) {
    lowest = std::min(lowest, raised(x, 400));
    highest = std::max(highest, raised(x, 400));
  }
  EXPECT_NEAR(highest, 0.022, 6e-5);
  EXPECT_NEAR(lowest, 0.022 - 6.2e-5, 6e-5);
}

TEST(DilateByBall, RollsOverSlopesWithinAMicrometre) {
  for (const double radius_m : {0.0005, 0.001, 0.003}) {
    for (auto* z : {+[](double x) { return 0.5 * x; }, +[](double x) { return 1.3 * x; },
                    +[](double x) { return 2.0 * x; }, +[](double x) { return 3.0 * x; }}) {
      const Errors errors = errors_of(relief_of_heights(200, 60, z), radius_m);
      EXPECT_GE(errors.least_m, -1e-6) << radius_m;
      EXPECT_LE(errors.most_m, 1e-6) << radius_m;
    }
  }
}

TEST(DilateByBall, RollsOverRoundHillsAndValleysWithinFiveMicrometres) {
  for (const double radius_m : {0.0005, 0.001}) {
    const Errors errors =
        errors_of(relief_of_heights(200, 60, [](double x) { return 0.002 * std::sin(x / 0.002); }), radius_m);
    EXPECT_GE(errors.least_m, -5e-6) << radius_m;
    EXPECT_LE(errors.most_m, 5e-6) << radius_m;
  }
}

/// A lower bound of the height of the centre of a ball above (x_m, y_m), by a search of all contacts.
double searched_centre_m(const Relief& relief, double radius_m, double x_m, double y_m) {
  constexpr int kAcross = 80;
  double best_m = -1.0;
  for (int j = -kAcross; j <= kAcross; ++j)
    for (int i = -kAcross; i <= kAcross; ++i) {
      const double dx = i * radius_m / kAcross;
      const double dy = j * radius_m / kAcross;
      const double depth2 = radius_m * radius_m - dx * dx - dy * dy;
      if (depth2 >= 0.0) best_m = std::max(best_m, relief.sample(x_m + dx, y_m + dy).z_m + std::sqrt(depth2));
    }
  return best_m;
}

Relief rough_ground(std::mt19937& random) {
  Raster<float> values(90, 90);
  std::uniform_real_distribution<float> height_m(0.0F, static_cast<float>(20.0 * kPixel_m));
  for (float& z : values.values()) z = height_m(random);
  limit_slope(values, kPixel_m, 3.0);
  return *Relief::from_samples(std::move(values), kPixel_m);
}

// Of several contacts that are nearly as high one was once missed: a ball sank up to 42 um into white noise.
TEST(DilateByBall, HardlySinksIntoRoughGround) {
  constexpr double kRadius_m = 0.002;
  for (const unsigned seed : {3U, 4U}) {
    std::mt19937 random(seed);
    const Relief relief = rough_ground(random);
    const Relief dilated = *Relief::from_samples(dilate_by_ball(relief, kRadius_m, {}), kPixel_m);
    std::uniform_real_distribution<double> place_m(-25.0 * kPixel_m, 25.0 * kPixel_m);
    double least_m = 0.0;
    for (int k = 0; k < 400; ++k) {
      const double x_m = place_m(random);
      const double y_m = place_m(random);
      least_m =
          std::min(least_m, dilated.sample(x_m, y_m).z_m - searched_centre_m(relief, kRadius_m, x_m, y_m));
    }
    EXPECT_GE(least_m, -12e-6) << "seed " << seed;
  }
}

TEST(DilateByBall, StandsTooHighInAGrooveByHalfAPixelTimesTheSlopeAtMost) {
  const Errors errors = errors_of(relief_of_heights(200, 60, [](double x) { return std::abs(x); }), 0.001);
  EXPECT_GE(errors.least_m, -5e-6);
  EXPECT_LE(errors.most_m, 0.5 * kPixel_m);
}

TEST(ErodeByBall, IsTheDilationOfTheOtherSide) {
  const auto lowered = erode_by_ball(relief_of_heights(200, 60, [](double x) { return x; }), 0.001, {});
  EXPECT_NEAR(lowered(100, 30), 0.5 * kPixel_m - 0.001 * std::sqrt(2.0), 1e-6);
}

}  // namespace
}  // namespace palpable::models
