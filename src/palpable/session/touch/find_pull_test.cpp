// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/find_pull.hpp"

#include "palpable/session/touch/test_session.hpp"

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

device::Traits motors(double max_force_N) {
  device::Traits traits;
  traits.pushes_back = true;
  traits.max_force_N = max_force_N;
  return traits;
}

TEST(FindPull, LeadsStraightToThePlaceWithAGentleForce) {
  FindPull pull;
  const auto guide = pull.begin(flat_scene(100, 100), motors(8.0), {0.0, 0.0}, {0.03, 0.01});
  ASSERT_NE(guide, nullptr);
  EXPECT_TRUE(models::is_valid(*guide));
  EXPECT_EQ(guide->line_m.back(), (std::array{0.03, 0.01}));
  EXPECT_DOUBLE_EQ(guide->force_N, FindPull::kForce_N);
  // A weak device gives a fifth of its force.
  EXPECT_DOUBLE_EQ(pull.begin(flat_scene(100, 100), motors(1.0), {}, {0.03, 0.01})->force_N, 0.2);
}

TEST(FindPull, IsNoneWithoutMotors) {
  FindPull pull;
  device::Traits pointer = motors(8.0);
  pointer.pushes_back = false;
  EXPECT_EQ(pull.begin(flat_scene(100, 100), pointer, {}, {0.03, 0.01}), nullptr);
  EXPECT_FALSE(pull.pulls());
}

TEST(FindPull, IsEndedByAHandThatMovesAway) {
  FindPull pull;
  const auto scene = flat_scene(100, 100);
  ASSERT_NE(pull.begin(scene, motors(8.0), {}, {0.03, 0.0}), nullptr);
  EXPECT_FALSE(pull.is_pushed_away(scene, {-0.007, 0.0}));
  EXPECT_FALSE(pull.is_pushed_away(scene, {0.02, 0.0}));
  // 9 mm back from where it was nearest.
  EXPECT_TRUE(pull.is_pushed_away(scene, {0.011, 0.0}));
  pull.end();
  EXPECT_FALSE(pull.is_pushed_away(scene, {-0.05, 0.0}));
}

}  // namespace
}  // namespace palpable::session
