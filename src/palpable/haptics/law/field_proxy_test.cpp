// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/field_proxy.hpp"

#include "palpable/haptics/law/penalty.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// A wall of 2 mm thickness across z. Its medial surface is smooth, as in a field.
class Wall {
 public:
  models::FieldSample sample(Point<SceneFrame> p) const noexcept {
    constexpr double kRound_m = 1e-4;
    const double z_m = p.v.z, height = std::abs(z_m);
    const double away = height < kRound_m ? 0.5 * (height * height / kRound_m + kRound_m) : height;
    const double slope = height < kRound_m ? z_m / kRound_m : (z_m > 0.0 ? 1.0 : -1.0);
    return {away - 0.001, {{0.0, 0.0, slope}}};
  }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }
};

class Ball {
 public:
  models::FieldSample sample(Point<SceneFrame> p) const noexcept { return {norm(p.v) - 0.02, {unit(p.v)}}; }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }
};

/// A box of 40 x 40 x 20 mm around the origin.
class Box {
 public:
  models::FieldSample sample(Point<SceneFrame> p) const noexcept {
    const Vec3 off{std::abs(p.v.x) - 0.02, std::abs(p.v.y) - 0.02, std::abs(p.v.z) - 0.01};
    const Vec3 out{std::max(off.x, 0.0), std::max(off.y, 0.0), std::max(off.z, 0.0)};
    const Vec3 sign{p.v.x < 0.0 ? -1.0 : 1.0, p.v.y < 0.0 ? -1.0 : 1.0, p.v.z < 0.0 ? -1.0 : 1.0};
    const double away_m = norm(out);
    if (away_m > 0.0)
      return {away_m, {{sign.x * out.x / away_m, sign.y * out.y / away_m, sign.z * out.z / away_m}}};
    const double most = std::max({off.x, off.y, off.z});
    return {most,
            {{off.x == most ? sign.x : 0.0, off.x < most && off.y == most ? sign.y : 0.0,
              off.x < most && off.y < most ? sign.z : 0.0}}};
  }
  double cell_m() const noexcept { return 1e-3; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }
};

MaterialMap material(double friction, double damping = 0.0) {
  return MaterialMap({1000.0, damping, friction, friction});
}
Hand hand_at(Vec3 p) { return {{p}, {}, 0.001}; }

TEST(FieldProxyLaw, NeverPopsThroughAThinWall) {
  const FieldProxyLaw<Wall> law(std::make_shared<const Wall>(), material(0.0), 0.0);
  FieldProxyLaw<Wall>::State state;
  LawOutput output;
  for (int i = 0; i <= 1000; ++i) output = law.evaluate(hand_at({0.0, 0.0, 0.005 - i * 2e-5}), state);
  // The hand is 14 mm beyond the far side of the wall and is still pushed back to the side from which it
  // came.
  EXPECT_TRUE(output.contact);
  EXPECT_NEAR(output.proxy.v.z, 0.001, 1e-6);
  EXPECT_NEAR(output.force_N.v.z, 16.0, 0.01);
}

TEST(FieldProxyLaw, FeelsTheMaterialUnderTheProxyNotUnderTheHand) {
  std::array<Contact, 256> contacts{};
  contacts[0] = {1000.0, 0.0, 10.0, 10.0};
  contacts[1] = {200.0, 0.0, 0.0, 0.0};
  Raster<std::uint8_t> halves(2, 1, 0);
  halves(1, 0) = 1;
  const FieldProxyLaw<Wall> law(std::make_shared<const Wall>(), MaterialMap(contacts, halves, 0.04, 0.04),
                                0.0);
  FieldProxyLaw<Wall>::State state;
  law.evaluate(hand_at({-0.0005, 0.0, 0.003}), state);
  law.evaluate(hand_at({-0.0005, 0.0, 0.0005}), state);
  // The left half has high friction: the hand crosses the border inside the wall, the proxy stays.
  const LawOutput output = law.evaluate(hand_at({0.0005, 0.0, 0.0005}), state);
  EXPECT_EQ(output.label, 0);
  EXPECT_NEAR(output.proxy.v.x, -0.0005, 1e-6);
  EXPECT_NEAR(output.force_N.v.x, -1.0, 1e-3);
}

TEST(FieldProxyLaw, KeepsAFastHandOnItsSide) {
  const FieldProxyLaw<Wall> law(std::make_shared<const Wall>(), material(0.0), 0.0);
  FieldProxyLaw<Wall>::State state;
  law.evaluate(hand_at({0.0, 0.0, 0.003}), state);
  LawOutput output;
  for (int i = 0; i < 4; ++i) output = law.evaluate(hand_at({0.0, 0.0, -0.002}), state);
  EXPECT_TRUE(output.contact);
  EXPECT_GT(output.force_N.v.z, 2.9);
}

TEST(FieldProxyLaw, SlidesRoundABallWithoutFriction) {
  const FieldProxyLaw<Ball> law(std::make_shared<const Ball>(), material(0.0), 0.0);
  FieldProxyLaw<Ball>::State state;
  LawOutput output;
  Vec3 hand;
  law.evaluate(hand_at({0.0, 0.0, 0.021}), state);
  for (int i = 0; i <= 2000; ++i) {
    const double angle = std::numbers::pi / 2000.0 * i;
    hand = 0.0195 * Vec3{std::sin(angle), 0.0, std::cos(angle)};
    output = law.evaluate(hand_at(hand), state);
    ASSERT_TRUE(output.contact);
    ASSERT_NEAR(norm(output.force_N), 0.5, 0.01);
  }
  EXPECT_GT(dot(unit(output.force_N.v), unit(hand)), 0.999);
}

TEST(FieldProxyLaw, SticksWithinTheFrictionCone) {
  const FieldProxyLaw<Wall> law(std::make_shared<const Wall>(), material(0.5), 0.0);
  FieldProxyLaw<Wall>::State state;
  law.evaluate(hand_at({0.0, 0.0, 0.0015}), state);
  law.evaluate(hand_at({0.0, 0.0, 0.0}), state);
  const LawOutput held = law.evaluate(hand_at({0.0004, 0.0, 0.0}), state);
  EXPECT_NEAR(held.proxy.v.x, 0.0, 1e-6);
  EXPECT_NEAR(held.force_N.v.x, -0.4, 1e-3);
  LawOutput slid;
  for (int i = 0; i < 200; ++i) slid = law.evaluate(hand_at({0.004, 0.0, 0.0}), state);
  EXPECT_NEAR(slid.force_N.v.x, -0.5, 0.01);
}

TEST(FieldProxyLaw, ReleasesAHandThatLeaves) {
  const FieldProxyLaw<Ball> law(std::make_shared<const Ball>(), material(0.3), 0.0);
  FieldProxyLaw<Ball>::State state;
  for (const double z : {0.022, 0.0195, 0.019, 0.0201, 0.021}) law.evaluate(hand_at({0.0, 0.0, z}), state);
  const LawOutput output = law.evaluate(hand_at({0.0, 0.0, 0.0215}), state);
  EXPECT_FALSE(output.contact);
  EXPECT_EQ(output.force_N.v, Vec3{});
  EXPECT_NEAR(output.proxy.v.z, 0.0215, 1e-9);
}

/// Moves a hand from `from` in steps until it is in the air again, and gives the force there.
double force_N_in_the_air_after(Vec3 above, Vec3 from, Vec3 step, double friction) {
  const FieldProxyLaw<Box> law(std::make_shared<const Box>(), material(friction), 0.0);
  FieldProxyLaw<Box>::State state;
  law.evaluate(hand_at(above), state);
  for (int k = 1; k <= 20; ++k) law.evaluate(hand_at(above + (k / 20.0) * (from - above)), state);
  Vec3 hand = from;
  EXPECT_TRUE(law.evaluate(hand_at(hand), state).contact);
  while (Box().sample({hand}).distance_m < 2e-4) {
    hand += step;
    law.evaluate(hand_at(hand), state);
  }
  // The way of this tick is in the air, and so is the straight way to where the proxy was.
  return norm(law.evaluate(hand_at(hand + step), state).force_N);
}

TEST(FieldProxyLaw, LetsGoOfAHandThatSlipsDeepOverAnEdgeInTheTickInWhichItIsInTheAir) {
  // 5 mm below the top it leaves through the side.
  for (const double friction : {0.0, 0.3})
    EXPECT_EQ(force_N_in_the_air_after({0.01, 0.0, 0.012}, {0.016, 0.0, 0.005}, {2e-4, 0.0, 0.0}, friction),
              0.0)
        << friction;
  // It came in through the side and leaves through the top, far from the proxy, which slid to the edge. With
  // friction the proxy stays at the side, behind the body, and holds the hand.
  const Vec3 beside{0.022, 0.0, 0.0}, inside{-0.01, 0.0, 0.0}, out{-1e-4, 0.0, 2e-4};
  EXPECT_EQ(force_N_in_the_air_after(beside, inside, out, 0.0), 0.0);
  EXPECT_GT(force_N_in_the_air_after(beside, inside, out, 0.3), 1.0);
}

TEST(PenaltyLawOnFields, GeneratesNoEnergyOnAClosedPath) {
  const PenaltyLaw<Wall> law(std::make_shared<const Wall>(), material(0.0), 0.0, 0.0);
  PenaltyLaw<Wall>::State state;
  double work_J = 0.0, swing_J = 0.0;
  Vec3 last{0.0, 0.0, 0.0009};
  constexpr int kSteps = 200000;
  for (int i = 1; i <= kSteps; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kSteps;
    const Vec3 p{0.001 * std::sin(t), 0.0005 * std::sin(2.0 * t), 0.0009 * std::cos(t)};
    const LawOutput output = law.evaluate(hand_at(0.5 * (p + last)), state);
    work_J += dot(output.force_N.v, p - last);
    swing_J = std::max(swing_J, output.stored_J);
    last = p;
  }
  EXPECT_GT(swing_J, 1e-4);
  EXPECT_LT(std::abs(work_J), 1e-6 * swing_J);
}

TEST(PenaltyLawOnFields, FeelsABallOfItsRadiusEarlier) {
  const PenaltyLaw<Ball> law(std::make_shared<const Ball>(), material(0.0), 0.001, 0.0);
  PenaltyLaw<Ball>::State state;
  EXPECT_FALSE(law.evaluate(hand_at({0.0211, 0.0, 0.0}), state).contact);
  EXPECT_NEAR(law.evaluate(hand_at({0.0206, 0.0, 0.0}), state).force_N.v.x, 0.4, 1e-9);
}

TEST(PenaltyLawOnFields, NeverPulls) {
  const PenaltyLaw<Ball> law(std::make_shared<const Ball>(), material(0.0, 50.0), 0.0, 0.0);
  PenaltyLaw<Ball>::State state;
  Hand leaving = hand_at({0.0199, 0.0, 0.0});
  leaving.velocity_m_per_s = {{1.0, 0.0, 0.0}};
  EXPECT_EQ(law.evaluate(leaving, state).force_N.v, Vec3{});
}

Textures ridges_all_over() {
  models::Material material;
  material.texture = {models::TouchTexture::Kind::ridges, 0.002, 50e-6, 0.0};
  return Textures({material});
}

TEST(FieldProxyLaw, FeelsATextureOnAFaceAsAReliefDoes) {
  const FieldProxyLaw<Wall> law(std::make_shared<const Wall>(), material(0.0), 0.0, ridges_all_over());
  const models::TexturePattern pattern({models::TouchTexture::Kind::ridges, 0.002, 50e-6, 0.0});
  FieldProxyLaw<Wall>::State state{};
  const double depth = 0.0005;
  law.evaluate(hand_at({0.0, 0.0, 0.002}), state);
  for (int k = 0; k < 200; ++k) law.evaluate(hand_at({0.0, 0.0, 0.001 - depth}), state);
  for (double x = 0.0; x < 0.004; x += 1e-5) {
    const LawOutput output = law.evaluate(hand_at({x, 0.0, 0.001 - depth}), state);
    const auto h = pattern.sample(x, 0.0);
    ASSERT_NEAR(output.force_N.v.z, 1000.0 * (depth + h.z_m), 2e-3);
    ASSERT_NEAR(output.force_N.v.x, -1000.0 * depth * h.dzdx, 2e-3);
  }
}

TEST(FieldProxyLaw, FeelsATextureOnEverySideOfASolid) {
  const FieldProxyLaw<Ball> law(std::make_shared<const Ball>(), material(0.0), 0.0, ridges_all_over());
  for (const Vec3 side : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{-1, 0, 0}, Vec3{0.6, 0.0, 0.8}}) {
    // Across the ridges on each side: the pattern's x axis is along y, z and x on the sides x, y and z.
    const Vec3 along = unit(Vec3{side.z, side.x, side.y} - dot(Vec3{side.z, side.x, side.y}, side) * side);
    FieldProxyLaw<Ball>::State state{};
    law.evaluate(hand_at(0.021 * side), state);
    double least = 1e9, most = 0.0;
    for (int k = 0; k < 1200; ++k) {
      const double angle = k * 5e-4;
      const Vec3 at = 0.0195 * (std::cos(angle) * side + std::sin(angle) * along);
      const LawOutput output = law.evaluate(hand_at(at), state);
      if (k < 200) continue;
      least = std::min(least, norm(output.force_N.v));
      most = std::max(most, norm(output.force_N.v));
    }
    // 0.5 N from the penetration depth, and a texture of up to 50 micrometres in both directions.
    EXPECT_GE(most - least, 0.03);
    EXPECT_LE(most, 0.62);
  }
}

}  // namespace
}  // namespace palpable::haptics
