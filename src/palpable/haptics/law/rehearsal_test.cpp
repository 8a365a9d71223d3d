// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/rehearsal.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/haptics/law/field_scenes.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// The places of a hand that wanders over a box, from 0.3 mm above its faces to 0.6 mm below, around its
/// edges too, mostly 0.05 to 0.2 mm a tick.
std::vector<Vec3> walk_around(Vec3 half_m, int ticks, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vec3> walk;
  Vec3 at{0.0, 0.0, half_m.z}, goal = at;
  for (int i = 0; i < ticks; ++i) {
    if (i % 60 == 0)
      goal = {(half_m.x + 2e-4) * uniform(random), (half_m.y + 2e-4) * uniform(random),
              half_m.z - 1.5e-4 + 4.5e-4 * uniform(random)};
    const Vec3 to_goal = goal - at;
    const double step_m = std::min(norm(to_goal), 1.25e-4 + 7.5e-5 * uniform(random));
    if (norm(to_goal) > 0.0) at += (step_m / norm(to_goal)) * to_goal;
    walk.push_back(at);
  }
  return walk;
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// What a tick found (FoundInField) is kept from its rehearsal: that must change no bit of any result.
TEST(Rehearsal, ChangesNoBitOfATouchOnAField) {
  constexpr Vec3 kHalf_m{0.020, 0.015, 0.010};
  const NamedScene box = box_of_leaves("box", kHalf_m);
  for (const double friction : {0.0, 0.5}) {
    LawParameters parameters;
    parameters.law = Law::proxy;
    parameters.static_friction = friction;
    parameters.dynamic_friction = 0.8 * friction;
    const auto touchable = make_touchable(box.scene, parameters);
    ASSERT_TRUE(touchable);
    TouchState rehearsed, plain;
    int contacts = 0, kept = 0;
    Hand last;
    for (const Vec3 place : walk_around(kHalf_m, 30000, 5)) {
      Hand hand;
      hand.position = {place};
      hand.velocity_m_per_s = {1000.0 * (place - last.position.v)};
      hand.acts_after_s = 0.5 * hand.dt_s;
      if (contacts > 0) {
        const AllocationScope allocations;
        rehearse(**touchable, last, rehearsed);
        ASSERT_EQ(allocations.count(), 0U);
      }
      kept += std::memcmp(&rehearsed.found, &plain.found, sizeof(FoundInField)) != 0 ? 1 : 0;
      const LawOutput a = (*touchable)->evaluate(hand, rehearsed), b = (*touchable)->evaluate(hand, plain);
      ASSERT_EQ(bits(a.force_N.v.x), bits(b.force_N.v.x));
      ASSERT_EQ(bits(a.force_N.v.y), bits(b.force_N.v.y));
      ASSERT_EQ(bits(a.force_N.v.z), bits(b.force_N.v.z));
      ASSERT_EQ(a.proxy.v, b.proxy.v);
      ASSERT_EQ(a.contact, b.contact);
      contacts += a.contact ? 1 : 0;
      last = hand;
    }
    EXPECT_GT(contacts, 5000);
    // Rehearsals did leave something else than the ticks before.
    EXPECT_GT(kept, 1000);
  }
}

}  // namespace
}  // namespace palpable::haptics
