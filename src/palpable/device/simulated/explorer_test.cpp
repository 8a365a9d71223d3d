// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/simulated/explorer.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

constexpr double kTick_s = 0.001;

/// The time for which a massless hand that follows the goal of the explorer is in contact with a pillar. The
/// pillar extends `half_m` to each side, is half as high as the workspace, and stands alone in the middle of
/// the floor.
double seconds_on_a_pillar(Explorer& explorer, double half_m, double seconds) {
  constexpr double kStiffness_N_per_m = 500.0;
  Vec3 hand_m, force_N;
  double felt_s = 0.0;
  for (int i = 0; i < static_cast<int>(seconds / kTick_s); ++i) {
    hand_m = explorer.step(hand_m, force_N, kTick_s);
    const bool inside = std::abs(hand_m.x) < half_m && std::abs(hand_m.y) < half_m && hand_m.z < 0.0;
    force_N = {0.0, 0.0, inside ? -kStiffness_N_per_m * hand_m.z : 0.0};
    if (inside) felt_s += kTick_s;
  }
  return felt_s;
}

TEST(Explorer, FindsAPillarThatStandsAloneInTheMiddle) {
  for (const auto script : {ExplorerOptions::Script::scan, ExplorerOptions::Script::random})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      ExplorerOptions options;
      options.script = script;
      options.seed = seed;
      Explorer explorer(options);
      EXPECT_GT(seconds_on_a_pillar(explorer, 0.006, 20.0), 0.1)
          << "seed " << seed << (script == ExplorerOptions::Script::scan ? ", scan" : ", random");
    }
}

TEST(Explorer, MovesItsGoalNoFasterThanAnArm) {
  ExplorerOptions options;
  const SurfaceStrokes apart{{{{-0.02, -0.03, 0.01}}, {{0.02, -0.03, -0.01}}},
                             {{{-0.03, 0.03, 0.0}}, {{-0.03, 0.02, 0.0}}}};
  for (const SurfaceStrokes& strokes : {SurfaceStrokes{}, apart}) {
    options.strokes = strokes;
    Explorer explorer(options);
    Vec3 before = explorer.step({}, {}, 0.0);
    for (int i = 0; i < 20000; ++i) {
      // There is never a contact, so the hand repeats its travels.
      const Vec3 goal = explorer.step(before, {}, kTick_s);
      ASSERT_LE(norm(goal - before), 0.25 * kTick_s) << "tick " << i;
      before = goal;
    }
  }
}

TEST(Explorer, StaysOnAPillarWhoseSurfaceItKnows) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ExplorerOptions options;
    options.seed = seed;
    options.strokes = {{{{-0.004, 0.0, 0.0}}, {{0.004, 0.0, 0.0}}},
                       {{{0.0, -0.004, 0.0}}, {{0.0, 0.004, 0.0}}}};
    Explorer explorer(options);
    EXPECT_GT(seconds_on_a_pillar(explorer, 0.006, 10.0), 6.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace palpable::device
