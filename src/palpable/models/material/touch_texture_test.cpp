// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/material/touch_texture.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

using Kind = TouchTexture::Kind;

TEST(TexturePattern, HasItsAmplitudeAndTheExactSlope) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.05, 0.05);
  for (const Kind kind : {Kind::grain, Kind::ridges, Kind::bumps}) {
    const TexturePattern pattern({kind, 0.003, 50e-6, 0.4});
    double highest = 0.0;
    for (int k = 0; k < 20000; ++k) {
      const double x = place(random);
      const double y = place(random);
      const HeightSample s = pattern.sample(x, y);
      highest = std::max(highest, std::abs(s.z_m));
      const double e = 1e-6;
      ASSERT_NEAR(s.dzdx, (pattern.sample(x + e, y).z_m - pattern.sample(x - e, y).z_m) / (2 * e), 2e-4);
      ASSERT_NEAR(s.dzdy, (pattern.sample(x, y + e).z_m - pattern.sample(x, y - e).z_m) / (2 * e), 2e-4);
    }
    EXPECT_LE(highest, 50e-6);
    EXPECT_GT(highest, 45e-6);
  }
}

TEST(TexturePattern, RepeatsRidgesAtTheirPitchAndAngle) {
  const TexturePattern straight({Kind::ridges, 0.002, 1e-4, 0.0});
  const TexturePattern turned({Kind::ridges, 0.002, 1e-4, M_PI / 2});
  for (double x = -0.01; x < 0.01; x += 0.00037) {
    EXPECT_NEAR(straight.sample(x, 0.003).z_m, straight.sample(x + 0.002, -0.011).z_m, 1e-9);
    EXPECT_NEAR(straight.sample(x, 0.003).z_m, turned.sample(0.005, x).z_m, 1e-9);
  }
  EXPECT_NEAR(straight.sample(0.0, 0.0).z_m, 1e-4, 4e-6);
  EXPECT_NEAR(straight.sample(0.001, 0.0).z_m, -1e-4, 4e-6);
}

TEST(TouchTexture, HasNamedKindsAndCheckedRanges) {
  for (const Kind kind : {Kind::none, Kind::grain, Kind::ridges, Kind::bumps})
    EXPECT_EQ(texture_kind_from(name_of(kind)), kind);
  EXPECT_FALSE(texture_kind_from("velvet"));
  EXPECT_TRUE(is_valid(TouchTexture{}));
  EXPECT_FALSE(is_valid(TouchTexture{Kind::grain, 1e-5, 1e-5, 0.0}));
  EXPECT_FALSE(is_valid(TouchTexture{Kind::grain, 0.001, 0.1, 0.0}));
  EXPECT_FALSE(is_valid(TouchTexture{Kind::grain, 0.001, 1e-5, NAN}));
}

}  // namespace
}  // namespace palpable::models
