// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/simulated/hand_script.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

constexpr double kTick_s = 0.001;

/// The time for which a massless hand that follows the goal of the script is in contact with a pillar. The
/// pillar extends `half_m` to each side, is half as high as the workspace, and stands alone in the middle of
/// the floor.
double seconds_on_a_pillar(HandScript& script, double half_m, double seconds) {
  constexpr double kStiffness_N_per_m = 500.0;
  Vec3 hand_m, force_N;
  double felt_s = 0.0;
  for (int i = 0; i < static_cast<int>(seconds / kTick_s); ++i) {
    hand_m = script.step(hand_m, force_N, kTick_s);
    const bool inside = std::abs(hand_m.x) < half_m && std::abs(hand_m.y) < half_m && hand_m.z < 0.0;
    force_N = {0.0, 0.0, inside ? -kStiffness_N_per_m * hand_m.z : 0.0};
    if (inside) felt_s += kTick_s;
  }
  return felt_s;
}

TEST(HandScript, FindsAPillarThatStandsAloneInTheMiddle) {
  for (const auto kind : {HandScriptOptions::Kind::scan, HandScriptOptions::Kind::random})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      HandScriptOptions options;
      options.kind = kind;
      options.seed = seed;
      HandScript script(options);
      EXPECT_GT(seconds_on_a_pillar(script, 0.006, 20.0), 0.1)
          << "seed " << seed << (kind == HandScriptOptions::Kind::scan ? ", scan" : ", random");
    }
}

TEST(HandScript, MovesItsGoalNoFasterThanAnArm) {
  HandScriptOptions options;
  const SurfaceStrokes apart{{{{-0.02, -0.03, 0.01}}, {{0.02, -0.03, -0.01}}},
                             {{{-0.03, 0.03, 0.0}}, {{-0.03, 0.02, 0.0}}}};
  for (const SurfaceStrokes& strokes : {SurfaceStrokes{}, apart}) {
    options.strokes = strokes;
    HandScript script(options);
    Vec3 before = script.step({}, {}, 0.0);
    for (int i = 0; i < 20000; ++i) {
      // There is never a contact, so the hand repeats its travels.
      const Vec3 goal = script.step(before, {}, kTick_s);
      ASSERT_LE(norm(goal - before), 0.25 * kTick_s) << "tick " << i;
      before = goal;
    }
  }
}

TEST(HandScript, StaysOnAPillarWhoseSurfaceItKnows) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    HandScriptOptions options;
    options.seed = seed;
    options.strokes = {{{{-0.004, 0.0, 0.0}}, {{0.004, 0.0, 0.0}}},
                       {{{0.0, -0.004, 0.0}}, {{0.0, 0.004, 0.0}}}};
    HandScript script(options);
    EXPECT_GT(seconds_on_a_pillar(script, 0.006, 10.0), 6.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace palpable::device
