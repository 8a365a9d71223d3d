// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "pulled_hand.hpp"

#include "palpable/haptics/tick/test_pressing_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>

namespace palpable::bench {
namespace {

constexpr double kRadius_m = 0.001;

}  // namespace

describe::Place pulled_hand(const models::Scene& scene, haptics::DilatedRelief& kept, double& most_made_J) {
  haptics::LawParameters law;
  law.radius_m = kRadius_m;
  haptics::HapticScene touched;
  touched.touchable = *haptics::make_touchable(scene, law, &kept);
  const auto& start = scene.guide->line_m.front();
  haptics::PressingHand hand(
      {start[0], start[1], models::relief_of(scene)->sample(start[0], start[1]).z_m + 2.0 * kRadius_m});
  haptics::TickOptions options;
  options.passivity = haptics::Passivity::observe;
  Ring<haptics::TouchEvent> events(1024);
  haptics::TickPipeline tick(hand, touched, options, events);
  constexpr double kStart_s = 3.0, kSlow_m_per_s = 0.02, kTick_s = 0.001;
  const double seconds = kStart_s + models::length_m(*scene.guide) / kSlow_m_per_s;
  for (int n = 0; n * kTick_s < seconds; ++n) {
    tick.step(n * kTick_s, kTick_s);
    while (events.take()) {
    }
  }
  most_made_J = std::max(most_made_J, tick.counts().made_max_without_controller_J);
  return {hand.place().x, hand.place().y};
}

}  // namespace palpable::bench
