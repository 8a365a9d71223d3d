// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "live_swings.hpp"

#include "palpable/haptics/tick/energy_touch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "live_touch.hpp"

namespace palpable::bench {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kTicks = 4000;

/// Something that swings about a place.
struct Swing {
  double middle_m = 0.0, by_m = 0.0, rate_hz = 0.0, phase = 0.0;
  double at(double t_s) const { return middle_m + by_m * std::sin(kTurn * (rate_hz * t_s + phase)); }
};

/// Where the hand wants to be, on a plate that is at this place.
Swing goal_of(Hands& hands, std::uint64_t seed, double plate_m, SwingBegins begins) {
  Swing goal{plate_m + kRadius_m, 0.0, 0.0, 0.0};
  switch (seed % 3) {
    case 0:  // rests
      goal.middle_m -= hands.between(0.0, 0.003);
      break;
    case 1:  // pushes
      goal.middle_m -= hands.between(0.003, 0.010);
      break;
    default:  // swings
      goal.middle_m -= hands.between(0.0, 0.004);
      goal.by_m = hands.between(0.001, 0.003);
      goal.rate_hz = hands.between(1.0, 13.0);
      goal.phase = hands.between(0.0, 1.0);
  }
  if (begins == SwingBegins::in_contact) goal.middle_m -= 0.001;
  return goal;
}

}  // namespace

Swung swing(std::uint64_t seed, SwingSize size, SwingBegins begins) {
  Hands hands(seed);
  const Scale scale = size == SwingSize::usual ? usual_scale() : true_scale();
  device::HandOptions hand = hands.hand();
  // What a hand receives is known to half a step of its sensor: 4 uJ at 0.8 N with the usual one.
  hand.resolution_m = seed % 2 == 0 ? 1e-7 : hand.resolution_m;
  const double x_m = hands.between(-0.04, 0.04), y_m = hands.between(-0.03, 0.03);
  const Swing plate{0.5 * scale.relief.size_m.z, hands.between(0.001, 0.003), hands.between(1.0, 10.0),
                    hands.between(0.0, 1.0)};
  const auto frame_at = [&](double t_s) {
    const double z = scale.depth_m(plate.at(t_s));
    return hands.frame([&](int, int) { return z; });
  };
  const Swing goal = goal_of(hands, seed, plate.at(0.0), begins);
  LiveTouch touch(scale, hand, frame_at(0.0));
  const double above_m = begins == SwingBegins::in_contact ? 0.0 : 0.012;
  touch.place({x_m, y_m, goal.at(0.0) + above_m});
  const double k = touch.stiffness_N_per_m();
  constexpr double kThrough_m = 0.0012, kComes_m_per_s = 0.03;
  Swung out;
  haptics::IntervalAccount account(0);
  Vec3 before_N, spring_m;
  bool was_in_contact = false;
  std::optional<Raster<float>> taken;
  for (int n = 0; n < kTicks; ++n) {
    const double t_s = 0.001 * n;
    if (n % kFramePeriod == 0) taken = frame_at(t_s);
    const double received_J = touch.received_J();
    const Vec3 true_m = touch.true_position_m();
    const auto& sample = touch.step({x_m, y_m, goal.at(t_s) + std::max(0.0, above_m - kComes_m_per_s * t_s)});
    if (taken && n % kFramePeriod == kDelay) touch.hand_over(*taken);
    const Vec3 force = sample.written_force_N.v;
    const bool contact = sample.has(haptics::flag::kContact);
    const Vec3 length_m = contact ? sample.proxy.v - sample.position.v : Vec3{};
    const double change_N = norm(force - before_N);
    out.tick_N = std::max(out.tick_N, change_N);
    if (contact && was_in_contact)
      out.step_N = std::max(out.step_N, change_N - k * norm(length_m - spring_m));
    out.brought_J = touch.counts().scene_change_J;
    // Within the sensor's step the hand is elsewhere.
    const double stored_J = 0.5 * k * squared_norm(length_m) - k * dot(length_m, true_m - sample.position.v);
    account.take(received_J - out.brought_J, stored_J);
    const double deep_m = touch.height_m(x_m, y_m) + kRadius_m - sample.position.v.z;
    out.through += deep_m > kThrough_m && !contact ? 1 : 0;
    out.in_contact += contact ? 1 : 0;
    before_N = force;
    spring_m = length_m;
    was_in_contact = contact;
  }
  out.beyond_J = seed % 2 == 0 ? account.most_J() : 0.0;
  out.said_J = touch.counts().made_max_without_controller_J;
  out.said_with_J = touch.counts().made_max_J;
  return out;
}

}  // namespace palpable::bench
