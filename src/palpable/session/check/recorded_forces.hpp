// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/servo/latency_recorder.hpp"
#include "palpable/haptics/tick/shown_work.hpp"
#include "palpable/session/check/findings.hpp"
#include "palpable/session/check/recorded_scenes.hpp"
#include "palpable/session/touch/recording_header.hpp"

#include <cstdint>
#include <limits>

namespace palpable::session {

/// Checks recorded values without the law: caps, growth of the force, its work, and the times of the ticks.
/// One thread.
class RecordedForces {
 public:
  RecordedForces(const RecordedSession& session, Findings& findings);

  /// Takes the hand's ticks in order. `touch` belongs to tick.scene_id; null if it is unknown.
  void take(const device::TouchSample& tick, const RecordedTouch* touch);

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t contact_ticks() const { return contact_ticks_; }
  std::uint64_t missed() const { return missed_; }
  double max_force_N() const { return max_force_N_; }
  double max_step_N() const { return max_step_N_; }
  double duration_s() const { return duration_s_; }
  /// Greatest work on the hand in a contact that began in free air, J. NaN if no contact law was used
  /// without a guide: for others the work alone proves nothing.
  double work_made_max_J() const { return known(work_.made_max_J()); }
  /// haptics::ShownWork::since_zero_max_J(), J. NaN as above.
  double work_since_zero_max_J() const { return known(work_.since_zero_max_J()); }
  haptics::LatencySummary periods() const { return periods_.summary(); }

 private:
  void check_time(const device::TouchSample& tick);
  /// Whether the time since the previous tick equals the period that this one states.
  bool agrees(const device::TouchSample& tick) const;
  /// A force that acted on although the next tick was late, and that was not cut.
  void check_held(const device::TouchSample& tick);
  void check_force(const device::TouchSample& tick, Vector<DeviceFrame> force_N);
  void check_work(const device::TouchSample& tick, const RecordedTouch* touch, Vector<DeviceFrame> force_N);
  double known(double value) const {
    return work_.counts() ? value : std::numeric_limits<double>::quiet_NaN();
  }

  const RecordedSession& session_;
  Findings& findings_;
  double max_allowed_N_;
  /// Around the end of what is replayed, the times may be those of the replaying loop.
  bool is_replay_;
  /// The slower of the rates of the loop and of the device, which may be a recording of a slower loop.
  double slowest_hz_;
  std::uint64_t ticks_ = 0;
  std::uint64_t contact_ticks_ = 0;
  std::uint64_t missed_ = 0;
  std::uint64_t next_tick_ = 0;
  double before_s_ = 0.0;
  device::Status before_status_ = device::Status::ok;
  double max_force_N_ = 0.0;
  double max_step_N_ = 0.0;
  double duration_s_ = 0.0;
  Vector<DeviceFrame> before_N_;
  bool knows_before_ = false;
  haptics::LatencyRecorder periods_;
  haptics::ShownWork work_;
};

/// Smallest energy that counts as generated. Less is within the uncertainty of the hand's position due to the
/// sensor's quantisation.
inline constexpr double kEnergyMade_J = 5e-6;
/// So long after a tick was due the watchdog has cut the force of a device with motors.
inline constexpr double kLongestHold_s = 0.005;
/// Smallest force that counts as a force in free air.
inline constexpr double kForceInAir_N = 1e-3;

/// Whether the hand, its path since the previous tick and the segment to its proxy are all clear of the
/// surface: then no contact force is possible. For contact laws.
bool is_in_free_air(const haptics::HapticScene& scene, const device::TouchSample& before,
                    const device::TouchSample& tick);

}  // namespace palpable::session
