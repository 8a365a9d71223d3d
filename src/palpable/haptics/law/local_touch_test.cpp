// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/local_touch.hpp"

#include "palpable/haptics/law/proxy.hpp"

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

using device::LocalSurface;

constexpr double kLocalStiffness_N_per_m = 500.0;

LocalSurface level_plane(double z_m) {
  LocalSurface surface;
  surface.kind = LocalSurface::Kind::plane;
  surface.place.v = {0.0, 0.0, z_m};
  surface.normal.v = {0.0, 0.0, 1.0};
  surface.stiffness_N_per_m = kLocalStiffness_N_per_m;
  surface.static_friction = 0.5;
  surface.dynamic_friction = 0.4;
  surface.read_at_s = 1.0;
  return surface;
}

/// Any plane that may come late, early, twice, or never, near the hand at the origin.
LocalSurface any_plane(std::mt19937& random) {
  const auto from = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  LocalSurface surface = level_plane(0.0);
  const Vec3 tilted{from(-1.0, 1.0), from(-1.0, 1.0), 1.0};
  surface.normal.v = tilted / norm(tilted);
  surface.place.v = {from(-0.002, 0.002), from(-0.002, 0.002), from(-0.003, 0.003)};
  surface.hand.v = {from(-0.03, 0.03), 0.0, 0.0};
  surface.stiffness_N_per_m = from(50.0, 900.0);
  surface.damping_Ns_per_m = from(0.0, 2.0);
  surface.static_friction = from(0.0, 1.0);
  surface.dynamic_friction = 0.8 * surface.static_friction;
  surface.read_at_s = from(1.0, 2.0);
  return surface;
}

TEST(LocalTouch, GivesAHandAtRestNoEnergyWhateverPlanesCome) {
  constexpr double kDepth_m = 0.002;
  constexpr double kComesUp_m_per_s = 0.02, kTick_s = 0.001, kStiffest_N_per_m = 900.0;
  const double given_J = 0.5 * kLocalStiffness_N_per_m * kDepth_m * kDepth_m;
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const auto current = std::make_shared<device::CurrentSurface>();
    const LocalTouch law(LocalSurface::Kind::plane, current);
    *current = {level_plane(kDepth_m), true};
    TouchState state{};
    double before_N = norm(law.evaluate({}, state).spring_N);
    EXPECT_NEAR(before_N, kLocalStiffness_N_per_m * kDepth_m, 1e-12);
    std::mt19937 random(seed);
    for (int tick = 0; tick < 500; ++tick) {
      if (random() % 3 == 0) current->surface = any_plane(random);
      if (random() % 50 == 0) current->surface.kind = LocalSurface::Kind::free;
      const LawOutput output = law.evaluate({}, state);
      ASSERT_LE(output.stored_J, given_J + 1e-15) << seed << ", " << tick;
      // What falling planes gave comes back slowly.
      ASSERT_LE(norm(output.spring_N), before_N + kStiffest_N_per_m * kComesUp_m_per_s * kTick_s + 1e-12)
          << seed << ", " << tick;
      before_N = norm(output.spring_N);
    }
  }
}

TEST(LocalTouch, DoesNotPushWhereAPlaneComesAfterTheHandHasGoneBelowIt) {
  const auto current = std::make_shared<device::CurrentSurface>();
  const LocalTouch law(LocalSurface::Kind::plane, current);
  LocalSurface free;
  free.kind = LocalSurface::Kind::free;
  *current = {free, true};
  TouchState state{};
  EXPECT_EQ(law.evaluate({}, state).force_N.v, Vec3{});
  current->surface = level_plane(0.003);
  EXPECT_EQ(law.evaluate({}, state).force_N.v, Vec3{});
}

TEST(LocalTouch, PullsInContactOnlyAndGivesNoMoreThanItsReserve) {
  constexpr double kReserve_J = 0.004, kPull_N = 0.3, kTick_s = 0.001, kDepth_m = 0.001;
  const auto current = std::make_shared<device::CurrentSurface>();
  const LocalTouch law(LocalSurface::Kind::plane, current);
  LocalSurface pulled = level_plane(0.0);
  pulled.static_friction = pulled.dynamic_friction = 0.0;
  pulled.pull_N.v = {kPull_N, 0.0, 0.0};
  pulled.pull_reserve_J = kReserve_J;
  TouchState state{};
  double given_J = 0.0, before_N = 0.0, most_N = 0.0;
  // Along the pull at 50 mm/s in contact, back through the air, and again.
  for (int tick = 0; tick < 4000; ++tick) {
    const int phase = tick % 800;
    const bool presses = phase < 400;
    Hand hand;
    hand.dt_s = kTick_s;
    hand.position.v = {5e-5 * (presses ? phase : 800 - phase), 0.0, presses ? -kDepth_m : kDepth_m};
    pulled.hand.v = hand.position.v;
    pulled.read_at_s += kTick_s;
    *current = {pulled, true};
    const LawOutput output = law.evaluate(hand, state);
    EXPECT_TRUE(presses || output.guide_N.v == Vec3{}) << tick;
    EXPECT_EQ(output.guide_reserve_J, kReserve_J);
    EXPECT_LE(output.guide_N.v.x - before_N, 10.0 * kTick_s + 1e-9) << "it grows slowly";
    if (presses && phase > 0) given_J += 5e-5 * before_N;
    before_N = output.guide_N.v.x;
    most_N = std::max(most_N, before_N);
  }
  EXPECT_NEAR(most_N, kPull_N, 0.05 * kPull_N);
  EXPECT_LE(given_J, kReserve_J * (1.0 + 1e-9));
  EXPECT_GT(given_J, 0.9 * kReserve_J);
  // Another pull has a reserve of its own.
  pulled.pull_reserve_J = 2.0 * kReserve_J;
  pulled.hand.v = {};
  double next_N = 0.0;
  for (int tick = 0; tick < 400; ++tick) {
    pulled.read_at_s += kTick_s;
    *current = {pulled, true};
    next_N = law.evaluate({{{0.0, 0.0, -kDepth_m}}, {}, kTick_s}, state).guide_N.v.x;
  }
  EXPECT_NEAR(next_N, kPull_N, 0.01 * kPull_N);
}

TEST(LocalTouch, BringsTheVibrationThatCameWithTheSurface) {
  const auto current = std::make_shared<device::CurrentSurface>();
  const LocalTouch law(LocalSurface::Kind::plane, current);
  current->surface.transient = {4.0, 100.0, 80.0};
  ASSERT_NE(law.transient(), nullptr);
  EXPECT_EQ(*law.transient(), current->surface.transient);
}

/// A flat relief with a texture, turned, moved and shrunk at the device.
class LaidOnAPlane : public testing::Test {
 protected:
  static constexpr double kHeight_m = 0.001;
  LaidOnAPlane() {
    models::Material material;
    material.texture.kind = models::TouchTexture::Kind::bumps;
    material.texture.pitch_m = 0.003;
    material.texture.height_m = 30e-6;
    textures_ = {material};
    const double c = std::cos(0.4), s = std::sin(0.4);
    scene_from_device_ = {{c, -s, 0, s, c, 0, 0, 0, 1}, {0.004, -0.003, 0.0}, 2.0};
  }
  Transform<SceneFrame, DeviceFrame> scene_from_device_;
  std::vector<models::Material> textures_;
};

TEST_F(LaidOnAPlane, HasTheForceOfTheScenesLaw) {
  Raster<float> samples(60, 60, static_cast<float>(kHeight_m));
  auto relief = models::Relief::from_samples(std::move(samples), 0.001);
  ASSERT_TRUE(relief);
  using Bounded = models::BoundedRelief;
  const double scale = scene_from_device_.scale;
  const ProxyLaw<Bounded> law(
      std::make_shared<const Bounded>(std::make_shared<const models::Relief>(std::move(*relief))),
      MaterialMap(Contact{kLocalStiffness_N_per_m / scale, 0.0, 0.0, 0.0}), Textures(textures_));
  const auto device_from_scene = scene_from_device_.inverse();
  const auto current = std::make_shared<device::CurrentSurface>();
  LocalSurface plane = level_plane((device_from_scene * Point<SceneFrame>{{0.0, 0.0, kHeight_m}}).v.z);
  plane.static_friction = plane.dynamic_friction = 0.0;
  plane.texture = {1, device::LaidTexture::Onto::plan, scene_from_device_.rotation,
                   scene_from_device_.translation_m, scale};
  *current = {plane, true};
  const LocalTouch local(LocalSurface::Kind::plane, current, Textures(textures_));
  ProxyLaw<Bounded>::State there{};
  TouchState here{};
  double most_N = 0.0;
  for (int tick = 0; tick < 400; ++tick) {
    // From above the surface, 50 mm/s along it.
    const Vec3 v{0.05, 0.0, tick < 40 ? -0.02 : 0.0};
    Hand near;
    near.position.v = {5e-5 * tick, 0.0, 0.0007 - 2e-5 * std::min(tick, 40)};
    near.velocity_m_per_s.v = v;
    Hand far;
    far.position = scene_from_device_ * Point<DeviceFrame>{near.position.v};
    far.velocity_m_per_s.v = scale * scene_from_device_.rotate(v);
    const Vec3 wanted_N = rotate_force(device_from_scene, law.evaluate(far, there).force_N).v;
    const Vec3 force_N = local.evaluate(near, here).force_N.v;
    // At first contact the scene's proxy is where the hand went through the surface, and a texture begins.
    if (tick < 200) continue;
    ASSERT_NEAR(norm(force_N - wanted_N), 0.0, 1e-6) << tick;
    most_N = std::max(most_N, std::hypot(force_N.x, force_N.y));
  }
  EXPECT_GT(most_N, 0.005);
}

TEST_F(LaidOnAPlane, IsSmoothWhereItsTextureIsNotKnown) {
  const auto current = std::make_shared<device::CurrentSurface>();
  LocalSurface plane = level_plane(0.001);
  plane.texture.number = 7;
  *current = {plane, true};
  const LocalTouch local(LocalSurface::Kind::plane, current, Textures(textures_));
  TouchState state{};
  const LawOutput output = local.evaluate({}, state);
  EXPECT_EQ(output.force_N.v.x, 0.0);
  EXPECT_NEAR(output.force_N.v.z, 0.001 * kLocalStiffness_N_per_m, 1e-12);
}

}  // namespace
}  // namespace palpable::haptics
