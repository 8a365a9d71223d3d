// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/safety/passivity.hpp"
#include "palpable/haptics/servo/latency_recorder.hpp"
#include "palpable/haptics/servo/velocity.hpp"
#include "palpable/session/check/findings.hpp"
#include "palpable/session/check/recorded_scenes.hpp"
#include "palpable/session/touch/recording_header.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace palpable::session {

/// What the recorded numbers say by themselves, without the law: caps, the growth of the force, its plain
/// work and the ticks' times. One thread.
class RecordedForces {
 public:
  RecordedForces(const RecordedSession& session, Findings& findings);

  /// The hand's ticks in order. `touch` is what tick.scene_id names; null where that is unknown.
  void take(const device::TouchSample& tick, const RecordedTouch* touch);

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t contact_ticks() const { return contact_ticks_; }
  std::uint64_t missed() const { return missed_; }
  double max_force_N() const { return max_force_N_; }
  double max_step_N() const { return max_step_N_; }
  double duration_s() const { return duration_s_; }
  /// The greatest work that a contact which began in free air did on the hand; NaN where no law of contact
  /// was felt: of others the work alone says nothing.
  double made_max_J() const {
    return counts_work_ ? observer_.made_max_J() : std::numeric_limits<double>::quiet_NaN();
  }
  haptics::LatencySummary periods() const { return periods_.summary(); }

 private:
  void check_time(const device::TouchSample& tick);
  /// Whether the time between two neighbouring ticks is the period that the later one states.
  bool agree(double between_ticks_s, double period_s) const;
  void check_force(const device::TouchSample& tick, Vector<DeviceFrame> force_N);
  void check_work(const device::TouchSample& tick, const RecordedTouch& touch);

  const RecordedSession& session_;
  Findings& findings_;
  double max_allowed_N_;
  /// A replay: after its end the times are those of the replaying loop.
  bool has_own_times_;
  std::uint64_t ticks_ = 0;
  std::uint64_t contact_ticks_ = 0;
  std::uint64_t missed_ = 0;
  std::uint64_t next_tick_ = 0;
  double before_s_ = 0.0;
  double max_force_N_ = 0.0;
  double max_step_N_ = 0.0;
  double duration_s_ = 0.0;
  Vector<DeviceFrame> before_N_;
  bool knows_before_ = false;
  haptics::LatencyRecorder periods_;
  haptics::PassivityObserver observer_;
  bool counts_work_ = false;
  haptics::FinePosition fine_;
  bool knows_place_ = false;
  double since_place_s_ = 0.0;
  static constexpr std::size_t kSent = 16;
  struct Sent {
    Vector<DeviceFrame> force_N;
    bool weakened = false;
  };
  std::array<Sent, kSent> sent_{};
  std::size_t newest_ = 0;
  std::size_t delay_;
};

/// The least energy that counts as made: less is within what the place of a hand between two steps of its
/// sensor is unknown by.
inline constexpr double kEnergyMade_J = 5e-6;
/// The least force that counts as one in free air.
inline constexpr double kForceInAir_N = 1e-3;

/// Whether the hand, its way since the tick before and the way to its proxy are all clear of the surface:
/// then nothing is there that could push. For laws of contact.
bool is_in_free_air(const haptics::HapticScene& scene, const device::TouchSample& before,
                    const device::TouchSample& tick);

}  // namespace palpable::session
