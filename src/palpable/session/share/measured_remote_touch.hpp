// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/session/share/remote_bench.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

// For tests: what a touch over a link was like.
namespace palpable::session {

inline constexpr double kHills_m = 0.004;

/// For figures, each touch takes as long as PALPABLE_REMOTE_SECONDS says, and what it was like is printed.
inline bool prints_remote_touches() { return std::getenv("PALPABLE_REMOTE_SECONDS") != nullptr; }
inline double seconds_of_a_remote_touch() {
  return prints_remote_touches() ? std::atof(std::getenv("PALPABLE_REMOTE_SECONDS")) : 8.0;
}

struct LinkCase {
  const char* name;
  LinkQuality quality;
  /// Else surfaces are mostly too old when they come, and the force is off.
  bool is_usable = true;
};
inline constexpr LinkCase kLinks[]{
    {"none", {}},
    {"5 ms", {0.005, 0.0, 0.0}},
    {"5 ms, jitter 5 ms, loss 1 %", {0.005, 0.005, 0.01}},
    {"20 ms", {0.02, 0.0, 0.0}},
    {"20 ms, jitter 10 ms, loss 2 %", {0.02, 0.01, 0.02}},
    {"20 ms, jitter 20 ms, loss 5 %, in any order, 10 % twice", {0.02, 0.02, 0.05, false, 0.1}},
    {"100 ms", {0.1, 0.0, 0.0}},
    {"100 ms, jitter 20 ms, loss 2 %", {0.1, 0.02, 0.02}, false}};

/// The greatest growth of a force in a tick: of the part that is new, as the rise limit counts it.
class GreatestGrowth {
 public:
  void take(Vec3 force_N) {
    const double size = norm(before_N_);
    const Vec3 along = size > 0.0 ? before_N_ / size : Vec3{};
    const double kept = std::clamp(dot(force_N, along), 0.0, size);
    most_N_ = std::max(most_N_, norm(force_N - kept * along));
    before_N_ = force_N;
  }
  double most_N() const { return most_N_; }

 private:
  Vec3 before_N_;
  double most_N_ = 0.0;
};

struct RemotelyTouched {
  haptics::TickCounts counts;
  double max_growth_N = 0.0;
  double max_force_N = 0.0;
  double contact_ticks = 0.0;
  /// The law's force at the device, against that of the scene's own law at the same places: root of the mean
  /// square of the difference, and of the force.
  double rms_difference_N = 0.0;
  double rms_force_N = 0.0;
  /// The most that the hand got in any time beyond what the scene's own potential stored at its beginning, J
  /// (a passive device gives nothing beyond). Of a law with a potential everywhere, which is never below 0.
  double beyond_potential_J = 0.0;
  /// The most that the hand had got from all forces since the beginning, J.
  double net_work_J = 0.0;
};

/// A simulated hand explores a scene over a link, with a law without damping.
inline RemotelyTouched remote_touch(const models::Scene& scene, const LinkQuality& quality,
                                    std::uint64_t seed, SentTextures sent = SentTextures::all,
                                    haptics::Law law = TouchSettings{}.law.law) {
  TouchSettings settings;
  settings.law.law = law;
  settings.law.damping_Ns_per_m = 0.0;
  device::HandOptions options;
  options.script.seed = seed;
  RemoteBench bench(std::make_unique<device::SimulatedHand>(options), scene, settings, quality, sent);
  const haptics::HapticScene& truth = bench.far_scene();
  const bool is_spring = truth.touchable->energy_model() == haptics::EnergyModel::spring;
  haptics::TouchState state{};
  RemotelyTouched touched;
  GreatestGrowth growth;
  double squares = 0.0, own_squares = 0.0, compared = 0.0;
  double work_J = 0.0, least_J = 1e9;
  Vec3 held_N, before_m;
  while (bench.t_s() < seconds_of_a_remote_touch()) {
    const haptics::TouchSample& sample = bench.step();
    const Vec3 force_N = sample.written_force_N.v;
    work_J += dot(held_N, sample.device_position.v - before_m);
    touched.net_work_J = std::max(touched.net_work_J, work_J);
    held_N = force_N;
    before_m = sample.device_position.v;
    EXPECT_TRUE(is_finite(force_N));
    growth.take(force_N);
    touched.max_force_N = std::max(touched.max_force_N, norm(force_N));
    haptics::Hand hand;
    hand.position = truth.scene_from_device * Point<DeviceFrame>{sample.device_position.v};
    hand.velocity_m_per_s = truth.scene_from_device * Vector<DeviceFrame>{sample.velocity_m_per_s.v};
    const haptics::LawOutput output = truth.touchable->evaluate(hand, state);
    least_J = std::min(least_J, work_J + std::max(0.0, output.stored_J / truth.scene_from_device.scale));
    touched.beyond_potential_J = std::max(touched.beyond_potential_J, work_J - least_J);
    const bool compares = sample.status == device::Status::ok && output.contact;
    touched.contact_ticks += sample.has(haptics::flag::kContact) ? 1.0 : 0.0;
    if (!compares) continue;
    const auto own_N = is_spring ? output.spring_N : output.force_N;
    const Vec3 true_N = rotate_force(truth.scene_from_device.inverse(), own_N).v;
    squares += squared_norm(sample.raw_force_N.v - true_N);
    own_squares += squared_norm(true_N);
    compared += 1.0;
  }
  touched.counts = bench.counts();
  touched.max_growth_N = growth.most_N();
  touched.rms_difference_N = std::sqrt(squares / std::max(1.0, compared));
  touched.rms_force_N = std::sqrt(own_squares / std::max(1.0, compared));
  return touched;
}

}  // namespace palpable::session
