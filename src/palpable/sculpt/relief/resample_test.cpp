// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/resample.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

template <class F>
Raster<float> sampled(int width, int height, F f) {
  Raster<float> z(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) z(x, y) = static_cast<float>(f((x + 0.5) / width, (y + 0.5) / height));
  return z;
}

TEST(Resample, KeepsAPlaneExactlyInsideTheBorder) {
  const auto plane = [](double u, double v) { return 0.3 * u - 0.7 * v + 0.1; };
  const auto small = sampled(12, 9, plane);
  for (const auto kind : {Resampling::bilinear, Resampling::bicubic}) {
    const auto large = resampled(small, 48, 36, kind);
    const auto wanted = sampled(48, 36, plane);
    // Beyond the border the surface is level, so the outermost cells are curved there.
    for (int y = 8; y < 28; ++y)
      for (int x = 8; x < 40; ++x) ASSERT_NEAR(large(x, y), wanted(x, y), 1e-6);
  }
}

TEST(Resample, IsThirdOrderWhereBilinearIsSecond) {
  const auto waves = [](double u, double v) { return std::sin(6.0 * u) * std::cos(5.0 * v); };
  const auto error = [&](int side, Resampling kind) {
    const auto large = resampled(sampled(side, side, waves), 4 * side, 4 * side, kind);
    const auto wanted = sampled(4 * side, 4 * side, waves);
    double worst = 0.0;
    for (int y = 12; y < 4 * side - 12; ++y)
      for (int x = 12; x < 4 * side - 12; ++x)
        worst = std::max(worst, std::abs(static_cast<double>(large(x, y) - wanted(x, y))));
    return worst;
  };
  EXPECT_NEAR(error(32, Resampling::bilinear) / error(64, Resampling::bilinear), 4.0, 1.0);
  EXPECT_GT(error(32, Resampling::bicubic) / error(64, Resampling::bicubic), 6.0);
  EXPECT_LT(error(32, Resampling::bicubic), 0.2 * error(32, Resampling::bilinear));
}

TEST(Resample, OvershootsAStepByNoMoreThanStated) {
  const auto step = [](double u, double) { return u < 0.5 ? 0.0 : 1.0; };
  const auto large = resampled(sampled(16, 16, step), 160, 160, Resampling::bicubic);
  const auto [low, high] = std::minmax_element(large.values().begin(), large.values().end());
  EXPECT_GE(*low, -1.0F / 13.0F);
  EXPECT_LE(*high, 1.0F + 1.0F / 13.0F);
  EXPECT_LT(*low, -0.02F) << "bicubic overshoots, bilinear does not";
}

TEST(Resample, RemovesFrequenciesAboveTheNewSamplingRate) {
  const auto stripes = [](double u, double) { return std::sin(2.0 * M_PI * 30.0 * u); };
  const auto few = resampled(sampled(128, 16, stripes), 32, 4, Resampling::bicubic);
  // Not at the border, where the stripes are cut off and continue level.
  for (int y = 0; y < 4; ++y)
    for (int x = 2; x < 30; ++x) EXPECT_LT(std::abs(few(x, y)), 0.03F);
}

}  // namespace
}  // namespace palpable::sculpt
