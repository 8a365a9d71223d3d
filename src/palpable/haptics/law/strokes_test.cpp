// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Hands that wander above, in and under surfaces, up to 2 m/s: none is let through, none is pulled, and the
// force changes by no more than hand and proxy moved.
#include "palpable/haptics/law/stroke_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kT_s = 0.001;
/// What the truth cannot decide.
constexpr double kMargin_m = 1e-6;
constexpr double kFastest_m_per_s = 2.0;
constexpr int kTicks = 100;

/// A box in which a hand wanders.
struct Room {
  Vec3 low;
  Vec3 high;
};

struct Findings {
  int inside = 0;
  int let_through = 0;
  int pulled = 0;
  int kicked = 0;
  int sunk = 0;
};

double bounced(double place, double low, double high, double& speed) {
  if (place < low || place > high) speed = -speed;
  return std::clamp(place, low, high);
}

/// One touch; `height_over(p)` > 0 outside, `sunk_m` is how deep its proxy may be.
template <class HeightOver>
void wander(const Touchable& touchable, const Room& room, std::mt19937_64& random, double sunk_m,
            HeightOver height_over, Findings& findings) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> direction;
  const Vec3 size = room.high - room.low;
  Vec3 p = room.low + Vec3{size.x * unit(random), size.y * unit(random), size.z};
  Vec3 velocity;
  TouchState state;
  Hand hand;
  Vec3 last = p;
  LawOutput before;
  int left = 0;
  for (int n = 0; n < kTicks; ++n) {
    if (left-- == 0) {
      const Vec3 way{direction(random), direction(random), 0.5 * direction(random)};
      velocity = (kFastest_m_per_s * std::pow(10.0, -2.0 * unit(random)) / norm(way)) * way;
      left = 5 + static_cast<int>(75.0 * unit(random));
    }
    if (n > 0) p += kT_s * velocity;
    p = {bounced(p.x, room.low.x, room.high.x, velocity.x), bounced(p.y, room.low.y, room.high.y, velocity.y),
         bounced(p.z, room.low.z, room.high.z, velocity.z)};
    hand.position = {p};
    hand.velocity_m_per_s = {velocity};
    const LawOutput output = touchable.evaluate(hand, state);
    const double force_N = norm(output.force_N);
    const bool inside = height_over(p) < -kMargin_m;
    findings.inside += inside ? 1 : 0;
    findings.let_through += inside && !(output.contact && force_N > 0.0) ? 1 : 0;
    findings.pulled += dot(output.proxy.v - p, output.force_N.v) < -1e-9 ? 1 : 0;
    findings.sunk += height_over(output.proxy.v) < -sunk_m ? 1 : 0;
    // To let go of a hand in free air at once is no kick.
    const double moved_m = norm(p - last) + norm(output.proxy - before.proxy);
    const double step_N = norm(output.force_N - before.force_N);
    if (n > 0 && output.contact && step_N > 1.05 * kStrokeStiffness_N_per_m * moved_m + 1e-6)
      ++findings.kicked;
    before = output;
    last = p;
  }
}

void expect_held(const Findings& findings) {
  EXPECT_EQ(findings.let_through, 0) << "of " << findings.inside;
  EXPECT_EQ(findings.pulled, 0);
  EXPECT_EQ(findings.sunk, 0);
  EXPECT_EQ(findings.kicked, 0);
  EXPECT_GT(findings.inside, 5000);
}

TEST(Strokes, LetNoHandThroughReliefsOfAnyResolution) {
  std::mt19937 scenes(11);
  std::mt19937_64 random(12);
  Findings findings;
  for (const double pixel_m : {0.0001, 0.0003, 0.001, 0.002})
    for (const double friction : {0.0, 0.6}) {
      const models::Scene scene = rough_scene(pixel_m, scenes);
      const auto& relief = *models::relief_of(scene);
      LawParameters p = frictionless();
      p.stiffness_N_per_m = kStrokeStiffness_N_per_m;
      p.static_friction = friction;
      const auto law = made(scene, p);
      for (int k = 0; k < 150; ++k)
        wander(
            *law, {{-0.028, -0.018, -0.001}, {0.028, 0.018, 0.014}}, random, 1e-9,
            [&](Vec3 at) { return at.z - relief.sample(at.x, at.y).z_m; }, findings);
    }
  expect_held(findings);
}

template <class Solid>
Findings over_solid() {
  std::mt19937_64 random(13);
  Findings findings;
  const Solid solid;
  for (const double friction : {0.0, 0.6}) {
    const SolidTouchable<Solid> touchable(friction);
    for (int k = 0; k < 500; ++k)
      wander(
          touchable, {{-0.02, -0.02, -0.004}, {0.02, 0.02, 0.012}}, random, 0.1 * solid.cell_m(),
          [&](Vec3 at) { return solid.sample(at).distance_m; }, findings);
  }
  return findings;
}

TEST(Strokes, LetNoHandThroughBallsOnAPlate) { expect_held(over_solid<Pebbles>()); }

TEST(Strokes, LetNoHandThroughThinWallsOfASolid) { expect_held(over_solid<Walls>()); }

}  // namespace
}  // namespace palpable::haptics
