// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// A touch without real time whose energy is counted by the hand's true movements, for tests of energy.

#include "palpable/haptics/safety/limits.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/safety/test_hands.hpp"
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

namespace palpable::haptics {

/// What a hand received beyond what it gave, J.
struct TouchedEnergy {
  /// In a contact that began in free air; and since any tick beyond what the spring stored then, which also
  /// sees energy that a long contact hides behind what its friction and dampers took before.
  double contact_J = 0.0;
  double interval_J = 0.0;
  /// What the forces that acted pushed the hand on with beyond what the law's own would have, summed over all
  /// ticks; and the most of a tick.
  double lag_J = 0.0;
  double lag_of_a_tick_J = 0.0;
  /// As the program says, without the controller.
  double said_J = 0.0;
  double contact_share = 0.0;
};

/// A touchable that keeps what its law returned last.
class KeptOutput final : public Touchable {
 public:
  explicit KeptOutput(std::shared_ptr<const Touchable> kept) : kept_(std::move(kept)) {}
  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override {
    return last_ = kept_->evaluate(hand, state);
  }
  std::uint64_t state_family() const noexcept override { return kept_->state_family(); }
  HandOver hand_over(const TouchState& state) const noexcept override { return kept_->hand_over(state); }
  void take_over(const HandOver& from, TouchState& state) const noexcept override {
    kept_->take_over(from, state);
  }
  double damping_Ns_per_m() const noexcept override { return kept_->damping_Ns_per_m(); }
  EnergyModel energy_model() const noexcept override { return kept_->energy_model(); }
  void touch_pages() const noexcept override { kept_->touch_pages(); }
  const LawOutput& last() const { return last_; }

 private:
  std::shared_ptr<const Touchable> kept_;
  mutable LawOutput last_;
};

/// The most that a hand received since any earlier tick beyond what the spring stored in the ticks whose
/// forces were then on their way.
class IntervalAccount {
 public:
  explicit IntervalAccount(int delay) : stored_J_(static_cast<std::size_t>(delay) + 1, 0.0) {}

  /// In a tick: what the hand received so far, and what the spring stores at its true position.
  void take(double received_J, double stored_J) {
    stored_J_.pop_front();
    stored_J_.push_back(stored_J);
    most_J_ = std::max(most_J_, received_J - least_J_);
    least_J_ = std::min(least_J_, received_J + *std::ranges::max_element(stored_J_));
  }
  double most_J() const { return most_J_; }

 private:
  std::deque<double> stored_J_;
  double least_J_ = std::numeric_limits<double>::infinity();
  double most_J_ = 0.0;
};

using MakeTouchable = std::function<std::shared_ptr<const Touchable>(const SafeContact&)>;

/// A hand that explores for so long at the stiffness limit of its device, without the controller.
inline TouchedEnergy touched_energy(const device::HandOptions& options, const MakeTouchable& touchable,
                                    int ticks = 10000, Returns returns = Returns::limited) {
  CountedHand hand(options);
  const auto kept =
      std::make_shared<KeptOutput>(touchable(safe_contact(hand.traits(), options.rate_hz, 1.0, 1e5, 0.5)));
  HapticScene scene;
  scene.touchable = kept;
  TickOptions observed;
  observed.passivity = Passivity::observe;
  observed.returns = returns;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(hand, scene, observed, events);
  IntervalAccount intervals(options.delay_samples);
  struct Force {
    Vec3 written_N;
    Vec3 law_N;
  };
  std::deque<Force> on_the_way(static_cast<std::size_t>(options.delay_samples));
  TouchedEnergy energy;
  for (int n = 0; n < ticks; ++n) {
    const double received_J = hand.total_J();
    const Vec3 true_m = hand.true_position_m();
    const TouchSample& sample = tick.step(0.001 * n, 0.001);
    if (!sample.has(flag::kContact)) hand.in_free_air();
    const LawOutput& law = kept->last();
    const double stored_J = law.stored_J - dot(law.spring_N.v, true_m - sample.position.v);
    intervals.take(received_J, std::isfinite(stored_J) ? stored_J : 0.0);
    on_the_way.push_back({sample.written_force_N.v, sample.raw_force_N.v});
    const Vec3 moved_m = hand.true_position_m() - true_m;
    const Force acted = on_the_way.front();
    on_the_way.pop_front();
    const double lag_J =
        std::max(0.0, dot(acted.written_N, moved_m) - std::max(0.0, dot(acted.law_N, moved_m)));
    energy.lag_J += lag_J;
    energy.lag_of_a_tick_J = std::max(energy.lag_of_a_tick_J, lag_J);
    while (events.take()) {
    }
  }
  energy.contact_J = hand.most_J();
  energy.interval_J = intervals.most_J();
  energy.said_J = tick.counts().made_max_without_controller_J;
  energy.contact_share = static_cast<double>(tick.counts().contact_ticks) / ticks;
  return energy;
}

/// A random hand that strokes a surface of 40 x 32 mm, held by a loose arm, with a sensor of 1 to 20 um.
inline device::HandOptions loose_hand(Hands& hands, unsigned seed, double fastest_m_per_s = 0.4) {
  device::HandOptions options = hands.next();
  options.resolution_m = hands.uniform(1e-6, 2e-5);
  options.arm_damping_Ns_per_m = hands.uniform(1.5, 3.0);
  options.arm_stiffness_N_per_m = hands.uniform(20.0, 300.0);
  options.script.kind = device::HandScriptOptions::Kind::random;
  options.script.workspace_m = {0.036, 0.028, 0.02};
  options.script.speed_m_per_s = hands.uniform(0.03, fastest_m_per_s);
  options.script.press_N = hands.uniform(0.3, 3.0);
  options.script.seed = seed;
  return options;
}

}  // namespace palpable::haptics
