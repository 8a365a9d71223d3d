// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/test_scenes.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

TEST(ProxyLaw, PushesFromFlatGroundWithExactlyTheSpringsForce) {
  for (const double radius_m : {0.0, 0.001}) {
    const auto law = made(flat_ground(), frictionless(radius_m));
    TouchState state;
    output_at(*law, state, {0, 0, 0.02});
    const Vec3 pressed{0.001, 0, 0.005 + radius_m - 0.002};
    // 15 mm exceeds the number of evaluations in one tick: the proxy arrives in the next tick.
    output_at(*law, state, pressed);
    const LawOutput output = output_at(*law, state, pressed);
    EXPECT_TRUE(output.contact);
    EXPECT_NEAR(output.force_N.v.z, 1.0, 0.005);
    EXPECT_NEAR(output.force_N.v.x, 0.0, 1e-6);
  }
}

TEST(ProxyLaw, GivesNoForceAboveTheSurface) {
  const auto law = made(scene_of(random_hills(100, 80, 3)), frictionless());
  TouchState state;
  for (double x = -0.02; x < 0.02; x += 0.0003) {
    const LawOutput output = output_at(*law, state, {x, 0.001, 0.02});
    EXPECT_FALSE(output.contact);
    EXPECT_EQ(norm(output.force_N), 0.0);
    EXPECT_EQ(output.proxy.v, (Vec3{x, 0.001, 0.02}));
  }
}

TEST(ProxyLaw, FindsANewTouchUnderTheSurface) {
  const auto law = made(flat_ground(), frictionless());
  TouchState state;
  EXPECT_TRUE(output_at(*law, state, {0, 0, 0.004}).contact);
}

TEST(ProxyLaw, SticksInsideTheConeAndSlidesOutsideIt) {
  LawParameters p = frictionless();
  p.static_friction = 0.5;
  p.dynamic_friction = 0.4;
  const auto law = made(flat_ground(), p);
  TouchState state;
  output_at(*law, state, {0, 0, 0.006});
  output_at(*law, state, {0, 0, 0.003});
  LawOutput output = output_at(*law, state, {0.00099, 0, 0.003});
  EXPECT_NEAR(output.proxy.v.x, 0.0, 1e-9) << "2 mm deep, the cone is 1 mm wide";
  output = output_at(*law, state, {0.0015, 0, 0.003});
  EXPECT_NEAR(output.proxy.v.x, 0.0015 - 0.4 * 0.002, 1e-6) << "now the dynamic coefficient holds";
  EXPECT_NEAR(-output.force_N.v.x / output.force_N.v.z, 0.4, 1e-3);
  const double rests = output.proxy.v.x;
  for (int k = 0; k < 1000; ++k) output = output_at(*law, state, {0.0015, 0, 0.003});
  EXPECT_EQ(output.proxy.v.x, rests) << "nothing drifts";
  output = output_at(*law, state, {rests + 0.00098, 0, 0.003});
  EXPECT_NEAR(output.proxy.v.x, rests, 1e-9) << "at rest, the static coefficient holds again";
}

TEST(ProxyLaw, KeepsTheForceInTheFrictionConeOnHills) {
  const models::Scene scene = scene_of(random_hills(200, 160, 5));
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  LawParameters p = frictionless();
  p.static_friction = 0.6;
  p.dynamic_friction = 0.3;
  const auto law = made(scene, p);
  TouchState state;
  for (int k = 0; k < 20000; ++k) {
    const double t = 0.001 * k;
    const double x = 0.017 * std::sin(2.0 * t);
    const double y = 0.013 * std::sin(3.1 * t);
    const LawOutput output = output_at(*law, state, {x, y, relief.sample(x, y).z_m - 0.0007});
    if (!output.contact) continue;
    const auto s = relief.sample(output.proxy.v.x, output.proxy.v.y);
    const Vec3 n = unit(Vec3{-s.dzdx, -s.dzdy, 1.0});
    const double normal = dot(output.force_N.v, n);
    const double along = norm(output.force_N.v - normal * n);
    ASSERT_GE(normal, -1e-9);
    ASSERT_LE(along, 0.6 * normal + 2e-3);
  }
}

// Also of a hand that moves by one to two pixels in a tick, of which one or more remain after the first
// contact.
TEST(ProxyLaw, IsNotDraggedOnAFrictionlessPlaneInTheTickOfTheFirstContact) {
  constexpr double kFine_m = 0.0005;
  const auto law = made(scene_of(Raster<float>(200, 200, 0.001F), kFine_m), frictionless());
  int contacts = 0;
  for (int k = 0; k < 600; ++k) {
    const double angle = 0.7 * k, moves_m = kFine_m * (0.2 + 0.006 * k);
    const double falls_m = 0.0001 + 0.0002 * std::fmod(0.37 * k, 1.0),
                 above_m = falls_m * std::fmod(0.61 * k, 1.0);
    TouchState state;
    for (int n = -2; n < 4; ++n) {
      const Vec3 hand{n * moves_m * std::cos(angle), n * moves_m * std::sin(angle),
                      0.001 + above_m - n * falls_m};
      const LawOutput output = output_at(*law, state, hand);
      if (!output.contact) continue;
      ++contacts;
      ASSERT_LT(std::hypot(output.force_N.v.x, output.force_N.v.y), 1e-6) << k << ' ' << n;
    }
  }
  EXPECT_GT(contacts, 1200);
}

// By approximated steps: mostly in the tick, and always when the hand stops.
TEST(ProxyLaw, ComesToTheEdgeOfTheFrictionConeWithinATenthOfAMicrometre) {
  const models::Scene scene = scene_of(random_hills(200, 160, 5));
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  LawParameters p = frictionless();
  p.static_friction = p.dynamic_friction = 0.3;
  const auto law = made(scene, p);
  TouchState state;
  const auto beyond_cone_m = [&](const LawOutput& output) {
    const auto s = relief.sample(output.proxy.v.x, output.proxy.v.y);
    const Vec3 n = unit(Vec3{-s.dzdx, -s.dzdy, 1.0});
    const double normal_N = dot(output.spring_N.v, n);
    return (norm(output.spring_N.v - normal_N * n) - 0.3 * normal_N) / *p.stiffness_N_per_m;
  };
  int far = 0;
  for (int k = 0; k < 4000; ++k) {
    const double t = 0.001 * k;
    const double x = 0.017 * std::sin(2.0 * t);
    const double y = 0.013 * std::sin(3.1 * t);
    const Vec3 hand{x, y, relief.sample(x, y).z_m - 0.0007};
    // In a few ticks three steps do not suffice.
    far += beyond_cone_m(output_at(*law, state, hand)) > 1.1e-7 ? 1 : 0;
    if (k % 20 != 0) continue;
    for (int rest = 0; rest < 4; ++rest) output_at(*law, state, hand);
    ASSERT_LE(beyond_cone_m(output_at(*law, state, hand)), 1.1e-7) << k;
  }
  EXPECT_LT(far, 200);
}

TEST(ProxyLaw, FeelsTheSameWhenSceneAndProbeAreTurnedTogether) {
  const Raster<float> hills = random_hills(120, 120, 7);
  Raster<float> turned(120, 120);
  // A rotation by 90 degrees to the left: the point (x, y) moves to (-y, x).
  for (int j = 0; j < 120; ++j)
    for (int i = 0; i < 120; ++i) turned(j, 119 - i) = hills(i, j);
  LawParameters p = frictionless(0.0006);
  p.static_friction = 0.3;
  const auto law = made(scene_of(hills), p);
  const auto law_turned = made(scene_of(turned), p);
  TouchState a;
  TouchState b;
  for (int k = 0; k < 4000; ++k) {
    const double t = 0.001 * k;
    const Vec3 at{0.009 * std::sin(2 * t), 0.008 * std::sin(3 * t + 1), 0.003 + 0.002 * std::sin(5 * t)};
    const Vec3 f = output_at(*law, a, at).force_N.v;
    const Vec3 g = output_at(*law_turned, b, {-at.y, at.x, at.z}).force_N.v;
    ASSERT_NEAR(norm(Vec3{-f.y, f.x, f.z} - g), 0.0, 2e-4) << k;
  }
}

TEST(ProxyLaw, GeneratesNoEnergyOnClosedPathsInContact) {
  // Without friction and damping the force is the gradient of half the stiffness times the distance squared.
  const models::Scene scene = scene_of(random_hills(200, 160, 11));
  const auto law = made(scene, frictionless());
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  const LoopWork loop = work_round(*law, 200000, 1, [&](double t) {
    const double x = 0.012 * std::sin(t);
    const double y = 0.009 * std::sin(2 * t);
    return Vec3{x, y, relief.sample(x, y).z_m - 0.0002 - 0.0001 * std::sin(3 * t)};
  });
  EXPECT_LE(std::abs(loop.net_J), 2e-5 * loop.swing_J);
}

TEST(ProxyLaw, DampsAlongTheNormalAndNeverPulls) {
  LawParameters p = frictionless();
  p.damping_Ns_per_m = 2.0;
  const auto law = made(flat_ground(), p);
  TouchState state;
  Hand hand;
  hand.position = {{0, 0, 0.004}};
  hand.velocity_m_per_s = {{0.3, 0, -0.1}};
  const LawOutput pressing = law->evaluate(hand, state);
  EXPECT_NEAR(pressing.force_N.v.z, 0.5 + 0.2, 1e-6);
  EXPECT_NEAR(pressing.force_N.v.x, 0.0, 1e-9);
  hand.velocity_m_per_s = {{0, 0, 1.0}};
  EXPECT_EQ(law->evaluate(hand, state).force_N.v.z, 0.0);
}

TEST(ProxyLaw, TakesEachRegionsMaterial) {
  models::Scene scene = flat_ground();
  models::Material soft;
  soft.stiffness_N_per_m = 100.0;
  soft.static_friction = soft.dynamic_friction = soft.damping_Ns_per_m = 0.0;
  models::Material hard = soft;
  hard.stiffness_N_per_m = 800.0;
  scene.materials = {soft, hard};
  scene.labels = Raster<std::uint8_t>(100, 80);
  for (int j = 0; j < 80; ++j)
    for (int i = 50; i < 100; ++i) scene.labels(i, j) = 1;
  const auto law = made(scene, {});
  TouchState state;
  output_at(*law, state, {-0.005, 0, 0.006});
  LawOutput output = output_at(*law, state, {-0.005, 0, 0.004});
  EXPECT_NEAR(output.force_N.v.z, 0.1, 1e-6);
  EXPECT_EQ(output.label, 0);
  double last = output.force_N.v.z;
  for (int k = 0; k < 200; ++k) {
    output = output_at(*law, state, {-0.005 + 0.00005 * k, 0, 0.004});
    EXPECT_LT(std::abs(output.force_N.v.z - last), 0.08) << "a border is no kick";
    last = output.force_N.v.z;
  }
  EXPECT_EQ(output.label, 1);
  EXPECT_NEAR(output.force_N.v.z, 0.8, 0.01);
}

}  // namespace
}  // namespace palpable::haptics
