// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/effect/texture.hpp"

#include "palpable/haptics/law/test_scenes.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

models::Scene textured_ground(models::TouchTexture texture) {
  models::Scene scene = flat_ground();
  scene.materials.front().texture = texture;
  return scene;
}

constexpr models::TouchTexture kRidges{models::TouchTexture::Kind::ridges, 0.002, 50e-6, 0.0};

TEST(Texture, RaisesTheSurfaceByItsHeight) {
  const auto law = made(textured_ground(kRidges), frictionless());
  const models::TexturePattern pattern(kRidges);
  TouchState state;
  output_at(*law, state, {-0.005, 0.0, 0.006});
  const double depth = 0.001;
  LawOutput output;
  for (int k = 0; k < 200; ++k) output = output_at(*law, state, {-0.005, 0.0, 0.005 - depth});
  for (double x = -0.005; x < 0.005; x += 1e-5) {
    output = output_at(*law, state, {x, 0.0, 0.005 - depth});
    const auto h = pattern.sample(x, 0.0);
    ASSERT_NEAR(output.force_N.v.z, 500.0 * (depth + h.z_m), 1e-3);
    ASSERT_NEAR(output.force_N.v.x, -500.0 * depth * h.dzdx, 1e-3);
    ASSERT_NEAR(output.stored_J, 500.0 * (0.5 * depth * depth + depth * h.z_m), 1e-9);
  }
}

TEST(Texture, GeneratesNoEnergyOnASlowClosedPath) {
  const auto law =
      made(textured_ground({models::TouchTexture::Kind::grain, 0.003, 1e-4, 0.3}), frictionless());
  const LoopWork loop = work_round(*law, 100000, 1, [](double t) {
    return Vec3{0.006 * std::sin(t), 0.004 * std::sin(2 * t), 0.004 - 0.0005 * std::sin(3 * t)};
  });
  EXPECT_LE(std::abs(loop.net_J), 1e-4 * loop.swing_J);
}

TEST(Texture, FadesBeforeTheHandIsTooFastForTheLoop) {
  const auto swing_at = [](double speed_m_per_s) {
    const auto law = made(textured_ground(kRidges), frictionless());
    TouchState state;
    double low = 1e9;
    double high = 0.0;
    Hand hand;
    hand.velocity_m_per_s = {{speed_m_per_s, 0.0, 0.0}};
    const int ticks = static_cast<int>(0.016 / (speed_m_per_s * hand.dt_s));
    for (int k = 0; k < ticks; ++k) {
      hand.position = {{-0.008 + k * speed_m_per_s * hand.dt_s, 0.0, 0.004}};
      const LawOutput output = law->evaluate(hand, state);
      if (k < ticks / 2) continue;
      low = std::min(low, output.force_N.v.z);
      high = std::max(high, output.force_N.v.z);
    }
    return high - low;
  };
  // An amplitude of 50 micrometres at 500 N/m.
  EXPECT_NEAR(swing_at(0.05), 0.05, 0.003);
  EXPECT_LT(swing_at(0.75), 0.03);
  EXPECT_LT(swing_at(1.05), 1e-6);
}

TEST(Texture, IsNoHigherThanTheWallCanRender) {
  models::TouchTexture high = kRidges;
  high.height_m = 1e-3;
  const auto law = made(textured_ground(high), frictionless());
  TouchState state;
  double most = 0.0;
  for (int k = 0; k < 2000; ++k)
    most = std::max(most, output_at(*law, state, {-0.005 + 5e-6 * k, 0.0, 0.004}).force_N.v.z);
  EXPECT_NEAR(most, 500.0 * (0.001 + max_texture_height_m(0.002)), 2e-3);
}

}  // namespace
}  // namespace palpable::haptics
