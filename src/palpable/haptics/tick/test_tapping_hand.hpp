// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Simulated hands that tap and press a level wall on random devices, for judging the stiffness limit.

#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <utility>

namespace palpable::haptics {

/// A device without friction, with a hand that damps as little as the limit assumes: 0.05 to 0.5 kg, 0.05 to
/// 1 N·s/m, held with 20 to 300 N/m, a delay of 0 to 2 ticks, a sensor of 1 to 20 µm.
/// With `slowest_sensor_s` above 0, its sensor has a period of 1 ms to that, on a logarithmic scale.
inline device::HandOptions random_device(std::mt19937_64& random, double slowest_sensor_s = 0.0) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  device::HandOptions hand;
  hand.device_mass_kg = between(0.05, 0.5);
  hand.device_damping_Ns_per_m = between(0.05, 1.0);
  hand.device_friction_N = 0.0;
  hand.arm_mass_kg = 0.0;
  hand.arm_damping_Ns_per_m = kLeastHandDamping_Ns_per_m;
  hand.arm_stiffness_N_per_m = between(20.0, 300.0);
  hand.resolution_m = between(1e-6, 20e-6);
  hand.delay_samples = static_cast<int>(random() % 3);
  hand.max_force_N = 10.0;
  hand.script.kind = device::HandScriptOptions::Kind::hold;
  constexpr double kTick_s = 0.001;
  if (slowest_sensor_s > kTick_s)
    hand.sensor_period_s = kTick_s * std::pow(slowest_sensor_s / kTick_s, between(0.0, 1.0));
  return hand;
}

/// The wall that safe_contact() makes of one that is far too stiff: the greatest stiffness that it allows on
/// this device, and the damping that goes with it.
inline SafeContact stiffest_wall(const device::HandOptions& hand) {
  constexpr double kFarTooStiff_N_per_m = 1e6;
  return safe_contact(device::SimulatedHand(hand).traits(), hand.rate_hz, 1.0, kFarTooStiff_N_per_m, 0.0);
}

/// The most energy that this hand receives in one contact with a level wall beyond what it gave, by the
/// wall's spring and damper alone, without return limit and controller. It taps the wall at 1 to 7 Hz with
/// goals 2 to 10 mm deep, presses it for a while, leaves, and does that again, for so many seconds.
inline double most_received_J(const device::HandOptions& options, double stiffness_N_per_m,
                              double damping_Ns_per_m, double seconds, std::uint64_t seed) {
  constexpr double kPeriod_s = 0.001;
  constexpr double kTapping_s = 2.0;
  constexpr double kPressing_s = 1.0;
  constexpr double kRound_s = kTapping_s + kPressing_s;
  models::Scene scene;
  constexpr int kSide = 16;
  scene.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(Raster<float>(kSide, kSide), 0.1 / kSide));
  LawParameters law;
  law.law = Law::proxy;
  law.stiffness_N_per_m = stiffness_N_per_m;
  law.damping_Ns_per_m = damping_Ns_per_m;
  HapticScene touched;
  touched.touchable = *make_touchable(scene, law);
  CountedHand hand(options);
  std::mt19937_64 random(seed);
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  TickOptions tick_options;
  tick_options.passivity = Passivity::observe;
  tick_options.returns = Returns::free;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(hand, touched, tick_options, events);
  // Goals without jumps: a hand does not accelerate like that.
  const double above_m = between(0.0, 0.005);
  double taps = 0.0, reach_m = 0.0, pressed_m = 0.0;
  for (int n = 0; n * kPeriod_s < seconds; ++n) {
    const double t = std::fmod(n * kPeriod_s, kRound_s);
    if (t < kPeriod_s) {
      taps = std::round(kTapping_s * between(1.0, 7.0));
      reach_m = between(0.002, 0.010);
      pressed_m = between(0.0, 0.010);
    }
    const bool taps_now = t < kTapping_s;
    const double way = taps_now ? taps * t / kTapping_s : (t - kTapping_s) / kPressing_s;
    const double depth_m =
        0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * way)) * (above_m + (taps_now ? reach_m : pressed_m));
    hand.set_goal({0.0, 0.0, above_m - depth_m});
    tick.step(n * kPeriod_s, kPeriod_s);
    while (events.take()) {
    }
    if (hand.true_position_m().z > 0.0) hand.in_free_air();
  }
  return hand.most_J();
}

}  // namespace palpable::haptics
