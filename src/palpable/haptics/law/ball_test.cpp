// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A ball on a relief with creases, where it touches two walls.
#include "palpable/haptics/law/test_scenes.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kRadius_m = 0.001;
constexpr double kStiffness_N_per_m = 500.0;

models::Scene groove_scene(double slope) {
  constexpr double kFine_m = 0.00015625;
  Raster<float> z(160, 120);
  for (int j = 0; j < z.height(); ++j)
    for (int i = 0; i < z.width(); ++i)
      z(i, j) = static_cast<float>(slope * std::abs(i - 0.5 * (z.width() - 1) - 0.31) * kFine_m);
  return scene_of(std::move(z), kFine_m);
}
constexpr double kMiddle_m = 0.31 * 0.00015625;

LawParameters ball_law() {
  LawParameters p;
  p.radius_m = kRadius_m;
  p.stiffness_N_per_m = kStiffness_N_per_m;
  p.damping_Ns_per_m = 0.0;
  p.static_friction = 0.0;
  return p;
}

Hand hand_at(Vec3 place_m) {
  Hand hand;
  hand.position.v = place_m;
  hand.dt_s = 0.001;
  return hand;
}

TEST(BallOnRelief, LiesInAGrooveWithinFiveMicrometres) {
  for (const double slope : {0.5, 1.0, 2.0, 3.0}) {
    const auto law = made(groove_scene(slope), ball_law());
    const Vec3 lowest{kMiddle_m, 0.0, kRadius_m * std::sqrt(1.0 + slope * slope)};
    TouchState state;
    LawOutput out;
    for (int n = 0; n <= 200; ++n)
      out = law->evaluate(hand_at(lowest + Vec3{0.0003, 0.0, 0.0002 - 1e-5 * n}), state);
    for (int n = 0; n < 50; ++n) out = law->evaluate(hand_at(lowest + Vec3{0.0, 0.0, -0.0018}), state);
    EXPECT_LE(norm(out.proxy.v - lowest) / std::sqrt(1.0 + slope * slope), 5e-6) << slope;
    EXPECT_NEAR(out.force_N.v.z, kStiffness_N_per_m * 0.0018, kStiffness_N_per_m * 1.2e-5) << slope;
  }
}

TEST(BallOnRelief, PushesSmoothlyWhileAHandCrossesBelowACrease) {
  const auto law = made(groove_scene(1.0), ball_law());
  const Vec3 lowest{kMiddle_m, 0.0, kRadius_m * std::sqrt(2.0)};
  TouchState state;
  // From below one wall to below the other, 2 mm deep: the ball stays in the crease.
  law->evaluate(hand_at(lowest + Vec3{-0.0008, 0.0, 0.002}), state);
  Vec3 last{};
  for (int n = 0; n <= 800; ++n) {
    const double share = std::min(1.0, n / 100.0);
    const Vec3 at = lowest + Vec3{-0.0008 + 2e-6 * n, 0.0, 0.002 - 0.004 * share};
    const LawOutput out = law->evaluate(hand_at(at), state);
    if (n > 150) {
      EXPECT_LE(norm(out.proxy.v - lowest), 1e-5) << n;
      EXPECT_LE(norm(out.force_N.v - last), kStiffness_N_per_m * 4e-6) << n;
    }
    last = out.force_N.v;
  }
}

}  // namespace
}  // namespace palpable::haptics
