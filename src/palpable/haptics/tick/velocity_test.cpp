// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/velocity.hpp"

#include "palpable/haptics/law/test_period.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

TEST(VelocityEstimator, IsTheBackwardDifferenceWithoutQuantisation) {
  VelocityEstimator velocity(0.0);
  EXPECT_EQ(velocity.update({{1.0, 2.0, 3.0}}, kT_s).v, Vec3{});
  const Vec3 v = velocity.update({{1.001, 2.0, 2.998}}, kT_s).v;
  EXPECT_NEAR(v.x, 1.0, 1e-9);
  EXPECT_NEAR(v.y, 0.0, 1e-9);
  EXPECT_NEAR(v.z, -2.0, 1e-9);
}

TEST(VelocityEstimator, UsesTheTimeThatReallyPassed) {
  VelocityEstimator velocity(0.0);
  velocity.update({{0.0, 0.0, 0.0}}, kT_s);
  EXPECT_NEAR(velocity.update({{0.003, 0.0, 0.0}}, 3.0 * kT_s).v.x, 1.0, 1e-9);
}

// A sensor with a clock of its own, whose readings a thread takes late, and then early.
TEST(VelocityEstimator, IsThatOfAWholePeriodInAShortTickAfterALateOne) {
  for (const double resolution_m : {0.0, 10e-6}) {
    VelocityEstimator velocity(resolution_m, 0.75 * kT_s);
    double x = 0.0;
    const auto passes = [&](double periods) {
      x += 0.2 * kT_s;
      return velocity.update({{x, 0.0, 0.0}}, periods * kT_s).v.x;
    };
    for (int n = 0; n < 20; ++n) passes(1.0);
    for (const double late : {1.9, 1.7, 1.3}) {
      passes(late);
      EXPECT_NEAR(passes(2.0 - late), 0.2, 1e-9) << late;
      for (int n = 0; n < 20; ++n) EXPECT_NEAR(passes(1.0), 0.2, 1e-9) << late;
    }
  }
}

TEST(VelocityEstimator, SmoothsTheStepsOfASensorThatTheBackwardDifferenceShows) {
  // 3 mm/s on a 10 µm sensor: a step every third tick, which the backward difference calls 0, 0, 10 mm/s.
  constexpr double kStep_m = 10e-6;
  VelocityEstimator velocity(kStep_m);
  double worst = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double x = kStep_m * std::round(0.003 * n * kT_s / kStep_m);
    const double v = velocity.update({{x, 0.0, 0.0}}, kT_s).v.x;
    if (n > 50) worst = std::max(worst, std::abs(v - 0.003));
  }
  EXPECT_LT(worst, 0.0015);
}

TEST(VelocityEstimator, FollowsAFastStopWithinTwoTicks) {
  constexpr double kStep_m = 10e-6;
  VelocityEstimator velocity(kStep_m);
  double x = 0.0;
  for (int n = 0; n < 100; ++n) velocity.update({{x += 0.5 * kT_s, 0.0, 0.0}}, kT_s);
  velocity.update({{x, 0.0, 0.0}}, kT_s);
  EXPECT_LT(std::abs(velocity.update({{x, 0.0, 0.0}}, kT_s).v.x), 1e-9);
}

/// The definition, line by line: the longest window whose samples are all within the resolution of the line
/// through its ends.
double slope_by_definition(const std::vector<double>& x_m, const std::vector<double>& t_s,
                           double resolution_m) {
  const std::size_t last = x_m.size() - 1;
  const auto slope = [&](std::size_t age) {
    return (x_m[last] - x_m[last - age]) / (t_s[last] - t_s[last - age]);
  };
  double best = slope(1);
  for (std::size_t age = 2; age < std::min<std::size_t>(x_m.size(), VelocityEstimator::kSamples); ++age) {
    for (std::size_t between = 1; between < age; ++between)
      if (std::abs(x_m[last] - slope(age) * (t_s[last] - t_s[last - between]) - x_m[last - between]) >
          (1.0 + 1e-6) * resolution_m)
        return best;
    best = slope(age);
  }
  return best;
}

TEST(VelocityEstimator, IsTheSlopeOfTheLongestWindowThatFits) {
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  for (int hand = 0; hand < 60; ++hand) {
    const double step_m = 1e-6 * uniform(1.0, 50.0);
    VelocityEstimator velocity(step_m);
    const double speed = std::exp(uniform(-9.0, -0.5));
    const double per_s = uniform(0.5, 40.0);
    std::vector<double> x_m;
    std::vector<double> t_s;
    double t = 0.0;
    for (int n = 0; n < 300; ++n) {
      const double dt_s = n % 7 == 0 ? uniform(1e-4, 5e-3) : kT_s;
      t += dt_s;
      const double place_m =
          speed / per_s * std::sin(per_s * t) + (n % 2 == 0 && hand % 3 == 0 ? step_m : 0.0);
      x_m.push_back(step_m * std::round(place_m / step_m));
      t_s.push_back(t);
      const double v = velocity.update({{0.0, x_m.back(), 0.0}}, dt_s).v.y;
      if (n > 0) {
        EXPECT_NEAR(v, slope_by_definition(x_m, t_s, step_m), 1e-9) << hand << ' ' << n;
      }
    }
  }
}

}  // namespace
}  // namespace palpable::haptics
