// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/sound_pull.hpp"

#include "palpable/haptics/effect/route_pull.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

device::Traits motors() {
  device::Traits traits;
  traits.max_force_N = 8.0;
  return traits;
}

std::optional<Place> at_right(Place hand) { return Place{0.04, hand.y_m}; }

TEST(SoundPull, PullsOnceForEachSoundAndSaysSo) {
  SoundPull pull;
  auto scene = flat_scene(100, 75);
  EXPECT_EQ(pull.guide(scene, motors(), {}, 0, false, at_right), nullptr);
  const auto guide = pull.guide(scene, motors(), {}, 1, true, at_right);
  ASSERT_NE(guide, nullptr);
  EXPECT_DOUBLE_EQ(guide->force_N, SoundPull::kForce_N);
  EXPECT_EQ(pull.words(), "A faint pull leads to where the sound comes from.");
  scene.guide = guide;
  EXPECT_EQ(pull.guide(scene, motors(), {0.02, 0.0}, 1, true, at_right), guide);
  // Pushed away: not again for the same sound, but for the next one.
  EXPECT_EQ(pull.guide(scene, motors(), {0.0, 0.0}, 1, true, at_right), nullptr);
  EXPECT_EQ(pull.words(), "The pull has ended: the hand was moved away.");
  EXPECT_EQ(pull.guide(scene, motors(), {0.0, 0.0}, 1, true, at_right), nullptr);
  EXPECT_EQ(pull.guide(scene, motors(), {0.0, 0.0}, 2, true, at_right), nullptr);
  scene.guide = nullptr;
  EXPECT_NE(pull.guide(scene, motors(), {0.0, 0.0}, 2, true, at_right), nullptr);
  EXPECT_EQ(pull.guide(scene, motors(), {0.0, 0.0}, 2, false, at_right), nullptr);
}

TEST(SoundPull, LeavesTheGuideOfAnother) {
  SoundPull pull;
  auto scene = flat_scene(100, 75);
  scene.guide = std::make_shared<const models::RouteGuide>();
  EXPECT_EQ(pull.guide(scene, motors(), {}, 1, true, at_right), scene.guide);
  EXPECT_FALSE(pull.words());
}

TEST(SoundPull, LeadsToTheNearestPlaceOfTheDirection) {
  const auto scene = flat_scene(100, 75);
  const Pinhole camera{60.0, 60.0, 49.5, 37.0, 100, 75};
  const auto place = sound_place(*models::relief_of(scene), camera, 0.0, std::atan(0.5), {0.0, 0.01});
  ASSERT_TRUE(place);
  // 30 px to the right of the middle, less the half of the band.
  EXPECT_NEAR(place->x_m, 0.027, 0.002);
  EXPECT_NEAR(place->y_m, 0.01, 0.001);
  EXPECT_FALSE(sound_place(*models::relief_of(scene), camera, 0.0, 2.5, {}));
}

/// A hand of 0.1 kg with a damper of 1 N·s/m that follows the pull gives back what the pull's reserve bounds.
TEST(SoundPull, GivesAHandLessThanItsReserve) {
  SoundPull pull;
  const auto guide = pull.guide(flat_scene(100, 75), motors(), {}, 1, true, at_right);
  ASSERT_NE(guide, nullptr);
  const haptics::RoutePull force(*guide, {0.05, 0.0375, 0.01});
  haptics::PullTouch state{};
  constexpr double kDt_s = 0.001, kMass_kg = 0.1, kDamping = 1.0;
  double x_m = 0.0, v_m_per_s = 0.0, work_J = 0.0, greatest_N = 0.0;
  for (int k = 0; k < 4000; ++k) {
    haptics::LawOutput output{};
    output.contact = true;
    haptics::Hand hand{};
    hand.position.v = {x_m, 0.0, 0.0};
    hand.dt_s = kDt_s;
    force.add(hand, state, output);
    const double force_N = output.force_N.v.x;
    greatest_N = std::max(greatest_N, std::abs(force_N));
    v_m_per_s += (force_N - kDamping * v_m_per_s) / kMass_kg * kDt_s;
    work_J += force_N * v_m_per_s * kDt_s;
    x_m += v_m_per_s * kDt_s;
  }
  EXPECT_NEAR(x_m, 0.04, 0.003);
  EXPECT_LE(greatest_N, SoundPull::kForce_N + 1e-6);
  EXPECT_GT(work_J, 0.004);
  EXPECT_LE(work_J, force.reserve_J());
  RecordProperty("work_uJ", static_cast<int>(1e6 * work_J));
}

}  // namespace
}  // namespace palpable::session
