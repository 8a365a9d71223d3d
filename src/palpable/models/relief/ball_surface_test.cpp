// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The surface of a ball against a dense search of its contacts, on scenes that are hard for it: creases at
// any angle to the grid, steps, plateaus, pits, spikes and noise.
#include "palpable/models/relief/relief_dilation.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

constexpr int kSide = 40;
constexpr double kBar_m = 5e-6;

/// The height of the centre of a ball over (x_m, y_m) by brute force: every contact on a fine grid below the
/// ball, and from the best of these a search by ever shorter steps.
class DenseSearch {
 public:
  DenseSearch(const Relief& relief, double radius_m) : relief_(relief), radius_m_(radius_m) {}

  double centre_m(double x_m, double y_m) const {
    const double step_m = std::min(relief_.pixel_m() / 4.0, radius_m_ / 40.0);
    const int n = static_cast<int>(std::ceil(radius_m_ / step_m));
    Raster<double> on(2 * n + 3, 2 * n + 3, kNone_m);
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i) on(i + n + 1, j + n + 1) = centre_on(x_m, y_m, {i * step_m, j * step_m});
    std::vector<std::pair<double, UnderBall>> peaks;
    for (int j = 1; j < on.height() - 1; ++j)
      for (int i = 1; i < on.width() - 1; ++i) {
        double around_m = kNone_m;
        for (int b = -1; b <= 1; ++b)
          for (int a = -1; a <= 1; ++a) around_m = std::max(around_m, on(i + a, j + b));
        if (on(i, j) > kNone_m && on(i, j) >= around_m)
          peaks.push_back({on(i, j), {(i - n - 1) * step_m, (j - n - 1) * step_m}});
      }
    std::sort(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr std::size_t kPeaks = 20;
    peaks.resize(std::min(peaks.size(), kPeaks));
    double best_m = kNone_m;
    for (const auto& [height_m, at] : peaks) best_m = std::max(best_m, climbed_m(x_m, y_m, at, step_m));
    return best_m;
  }

 private:
  static constexpr double kNone_m = -1e9;

  double centre_on(double x_m, double y_m, UnderBall at) const {
    const double depth2 = radius_m_ * radius_m_ - at.dx * at.dx - at.dy * at.dy;
    return depth2 < 0.0 ? kNone_m : relief_.sample(x_m + at.dx, y_m + at.dy).z_m + std::sqrt(depth2);
  }

  double climbed_m(double x_m, double y_m, UnderBall at, double step_m) const {
    double best_m = centre_on(x_m, y_m, at);
    while (step_m > 1e-9) {
      bool is_higher = false;
      for (int k = 0; k < 8 && !is_higher; ++k) {
        const double angle = k * std::acos(-1.0) / 4.0;
        const UnderBall next{at.dx + step_m * std::cos(angle), at.dy + step_m * std::sin(angle)};
        const double there_m = centre_on(x_m, y_m, next);
        if (there_m <= best_m) continue;
        best_m = there_m;
        at = next;
        is_higher = true;
      }
      step_m *= is_higher ? 1.3 : 0.5;
    }
    return best_m;
  }

  const Relief& relief_;
  double radius_m_;
};

struct Ground {
  std::string name;
  Relief relief;
};

/// Heights in pixels from a place in pixels, right and up from the middle.
Ground ground(const std::string& name, double pixel_m, double steepest,
              const std::function<double(double, double)>& height_px) {
  Raster<float> z(kSide, kSide);
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      z(i, j) = static_cast<float>(pixel_m * height_px(i - 0.5 * (kSide - 1), 0.5 * (kSide - 1) - j));
  if (steepest > 0.0) limit_slope(z, pixel_m, steepest);
  return {name, *Relief::from_samples(std::move(z), pixel_m)};
}

std::vector<Ground> grounds(double pixel_m, std::mt19937& random) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  constexpr double kSteepest = 3.0;
  std::vector<Ground> all;
  for (const double slope : {0.5, 1.0, 2.0, 3.0}) {
    const double angle = between(0.0, std::acos(-1.0));
    const double off = between(-1.0, 1.0);
    all.push_back(ground("groove " + std::to_string(slope), pixel_m, 0.0, [&](double x, double y) {
      return slope * std::abs(std::cos(angle) * x + std::sin(angle) * y + off);
    }));
  }
  const double angle = between(0.0, std::acos(-1.0));
  all.push_back(ground("step", pixel_m, kSteepest, [&](double x, double y) {
    return std::cos(angle) * x + std::sin(angle) * y > 0.0 ? 10.0 : 0.0;
  }));
  all.push_back(ground("plateau", pixel_m, kSteepest,
                       [](double x, double y) { return std::hypot(x, y) < 9.0 ? 12.0 : 0.0; }));
  all.push_back(ground("pit", pixel_m, kSteepest,
                       [](double x, double y) { return std::hypot(x, y) < 9.0 ? 0.0 : 12.0; }));
  all.push_back(ground("noise", pixel_m, kSteepest, [&](double, double) { return between(0.0, 20.0); }));
  all.push_back(ground("low noise", pixel_m, kSteepest, [&](double, double) { return between(0.0, 1.0); }));
  std::array<std::pair<double, double>, 16> spikes;
  for (auto& [x, y] : spikes) x = between(-16.0, 16.0), y = between(-16.0, 16.0);
  all.push_back(ground("spikes", pixel_m, kSteepest, [&](double x, double y) {
    double z = 0.0;
    for (const auto& [at_x, at_y] : spikes) z = std::max(z, 8.0 - 3.0 * std::hypot(x - at_x, y - at_y));
    return z;
  }));
  all.push_back(ground("hills", pixel_m, 0.0,
                       [](double x, double y) { return 4.0 * std::sin(0.3 * x) * std::cos(0.2 * y); }));
  return all;
}

/// Errors of the height of a ball's centre.
struct Off {
  double low_m = 0.0;
  double high_m = 0.0;
};

/// At random places, and at as many where the surface bends most: in creases and on tops.
Off errors_of(const Relief& relief, const RefinedRelief& surface, double radius_m, std::mt19937& random) {
  constexpr int kPlaces = 40;
  constexpr int kTried = 800;
  const double half_m = 0.42 * relief.size_x_m();
  std::uniform_real_distribution<double> across(-half_m, half_m);
  std::vector<std::array<double, 3>> places;
  for (int k = 0; k < kTried; ++k) {
    const double x = across(random);
    const double y = across(random);
    const CurvedSample s = surface.curved_sample(x, y);
    places.push_back({std::abs(s.dzdxx_per_m) + std::abs(s.dzdyy_per_m), x, y});
  }
  std::sort(places.begin() + kPlaces, places.end(), std::greater<>());
  const DenseSearch truth(relief, radius_m);
  Off off;
  for (int k = 0; k < 2 * kPlaces; ++k) {
    const auto [bend, x, y] = places[static_cast<std::size_t>(k)];
    const double error_m = surface.sample(x, y).z_m - truth.centre_m(x, y);
    off = {std::min(off.low_m, error_m), std::max(off.high_m, error_m)};
  }
  return off;
}

TEST(SurfaceOfBall, IsWithinFiveMicrometresOnSlopesUpToThree) {
  std::mt19937 random(21);
  for (const auto& [pixel_m, radius_m] :
       {std::pair{1e-4, 1e-3}, {1.6e-4, 3e-4}, {2.5e-4, 1e-3}, {2e-4, 3e-3}})
    for (const Ground& on : grounds(pixel_m, random)) {
      const Off off =
          errors_of(on.relief, *surface_of_ball(on.relief, radius_m, FinerFit{}, {}), radius_m, random);
      EXPECT_GE(off.low_m, -kBar_m) << on.name << " pixel " << pixel_m << " ball " << radius_m;
      EXPECT_LE(off.high_m, kBar_m) << on.name << " pixel " << pixel_m << " ball " << radius_m;
    }
}

TEST(SurfaceOfBall, IsTwiceContinuouslyDifferentiable) {
  std::mt19937 random(22);
  constexpr double kPixel_m = 2.5e-4;
  for (const Ground& on : grounds(kPixel_m, random)) {
    const RefinedRelief surface = *surface_of_ball(on.relief, 1e-3, FinerFit{}, {});
    ASSERT_NE(surface.cells(), nullptr) << on.name;
    std::uniform_real_distribution<double> across(-0.5 * on.relief.size_x_m(), 0.5 * on.relief.size_x_m());
    std::uniform_int_distribution<int> line(0, kSide);
    // Across the borders of cells, which may have different levels.
    for (int k = 0; k < 2000; ++k) {
      const double at = (line(random) - 0.5 * kSide) * kPixel_m + 0.5 * kPixel_m;
      const double along = across(random);
      constexpr double kStep_m = 1e-11;
      const bool is_upright = k % 2 == 0;
      const auto sample = [&](double side) {
        const double x = is_upright ? at + side * kStep_m : along;
        return surface.curved_sample(x, is_upright ? along : at + side * kStep_m);
      };
      const CurvedSample a = sample(-1.0);
      const CurvedSample b = sample(1.0);
      ASSERT_NEAR(a.z_m, b.z_m, 2e-8) << on.name;
      ASSERT_NEAR(a.dzdx, b.dzdx, 3e-3) << on.name;
      ASSERT_NEAR(a.dzdy, b.dzdy, 3e-3) << on.name;
      // The rounding of the control values, over the smallest part squared.
      const double bend_per_m = std::abs(a.dzdxx_per_m) + std::abs(a.dzdyy_per_m) + std::abs(a.dzdxy_per_m);
      ASSERT_NEAR(a.dzdxx_per_m, b.dzdxx_per_m, 300.0 + 0.01 * bend_per_m) << on.name;
      ASSERT_NEAR(a.dzdyy_per_m, b.dzdyy_per_m, 300.0 + 0.01 * bend_per_m) << on.name;
    }
  }
}

TEST(SurfaceOfBall, DoesNotDependOnTheNumberOfThreads) {
  std::mt19937 random(23);
  const std::vector<Ground> all = grounds(2.5e-4, random);
  Work one;
  one.threads = 1;
  Work three;
  three.threads = 3;
  const Ground& rough = all[7];
  const RefinedRelief a = *surface_of_ball(rough.relief, 1e-3, FinerFit{}, one);
  const RefinedRelief b = *surface_of_ball(rough.relief, 1e-3, FinerFit{}, three);
  std::uniform_real_distribution<double> across(-0.004, 0.004);
  for (int k = 0; k < 2000; ++k) {
    const double x = across(random);
    const double y = across(random);
    ASSERT_EQ(a.sample(x, y).z_m, b.sample(x, y).z_m);
  }
}

TEST(SurfaceOfBall, TakesNoMoreControlValuesThanAllowedAndBeginsWithTheLargestErrors) {
  std::mt19937 random(24);
  const std::vector<Ground> all = grounds(2.5e-4, random);
  const Ground& rough = all[7];
  const RefinedRelief free = *surface_of_ball(rough.relief, 1e-3, FinerFit{}, {});
  FinerFit tight;
  tight.most_values = 20.0 * kSide * kSide;
  const RefinedRelief held = *surface_of_ball(rough.relief, 1e-3, tight, {});
  EXPECT_GT(free.memory_bytes(), 40 * kSide * kSide * sizeof(float));
  // Beside the values there are the tables, and the bounds of each cell.
  EXPECT_LT(held.memory_bytes(), 26 * kSide * kSide * sizeof(float));
  const Off coarse = errors_of(rough.relief, *coarse_surface_of_ball(rough.relief, 1e-3, {}), 1e-3, random);
  const Off off = errors_of(rough.relief, held, 1e-3, random);
  EXPECT_LT(off.high_m - off.low_m, 0.7 * (coarse.high_m - coarse.low_m));
}

TEST(SurfaceOfBall, StopsWhenCancelled) {
  std::mt19937 random(25);
  const std::atomic<bool> cancel = true;
  Work work;
  work.cancel = &cancel;
  const auto surface = surface_of_ball(grounds(2.5e-4, random)[0].relief, 1e-3, FinerFit{}, work);
  ASSERT_FALSE(surface.has_value());
  EXPECT_EQ(surface.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace palpable::models
