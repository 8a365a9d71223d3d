// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "pulled_hand.hpp"

#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>

namespace palpable::bench {
namespace {

constexpr double kRadius_m = 0.001;

class PressingHand final : public device::Device {
 public:
  explicit PressingHand(Vec3 start) : place_(start) {
    traits_.name = "pressing hand";
    traits_.position_resolution_m = 0.0;
    traits_.workspace_m = {0.2, 0.2, 0.1};
  }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    constexpr double kMass_kg = 0.1, kDamping_Ns_per_m = 3.0, kPress_N = 0.6, kStep_s = 1e-4;
    constexpr int kSteps = 10;
    for (int k = 0; k < kSteps; ++k) {
      const Vec3 force = force_ - kDamping_Ns_per_m * speed_ + Vec3{0.0, 0.0, -kPress_N};
      speed_ = speed_ + kStep_s / kMass_kg * force;
      place_ = place_ + kStep_s * speed_;
    }
    device::Reading reading;
    reading.position = {place_};
    return reading;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override { force_ = force_N.v; }
  void stop() noexcept override { force_ = {}; }
  Vec3 place() const { return place_; }

 private:
  device::Traits traits_;
  Vec3 place_, speed_, force_;
};

}  // namespace

describe::Place pulled_hand(const models::Scene& scene, haptics::DilatedRelief& kept, double& most_made_J) {
  haptics::LawParameters law;
  law.radius_m = kRadius_m;
  haptics::HapticScene touched;
  touched.touchable = *haptics::make_touchable(scene, law, &kept);
  const auto& start = scene.guide->line_m.front();
  PressingHand hand(
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
