// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/haptics/servo/tick_options.hpp"

#include <limits>

namespace palpable::haptics {

/// What a reading is used for.
enum class ReadingUse {
  /// The touch continues there.
  continues,
  /// The hand is there, but did not get there by moving: a new touch.
  new_touch,
  /// Not plausible, and not yet known whether it lasts: the force stays as it is.
  glitch,
  /// No position is known: the force ramps down.
  none
};

/// One reading, judged.
struct JudgedReading {
  ReadingUse use = ReadingUse::none;
  /// The reading was not finite, out of reach, or moved or turned faster than a hand can.
  bool implausible = false;
  /// No good reading came before it, or it begins a new touch.
  bool first = false;
  /// Since the last good reading; the tick's own time where it is the first. Seconds.
  double passed_s = 0.0;

  bool is_good() const noexcept { return use == ReadingUse::continues || use == ReadingUse::new_touch; }
};

/// Decides which readings of a device are a hand's movement. A hand moves at TickOptions::max_speed_m_per_s
/// at most. A faster reading is a glitch for TickOptions::glitch_readings ticks; if the readings after it
/// agree with it, the hand is there, and a new touch begins. Readings that agree with nothing are not used.
/// Tick path; no allocation.
class ReadingFilter {
 public:
  ReadingFilter(const device::Traits& device, const TickOptions& options) noexcept;

  /// `dt_s` > 0 since the reading before.
  JudgedReading judge(const device::Reading& reading, double dt_s) noexcept;

 private:
  bool is_in_reach(Point<DeviceFrame> position) const noexcept;
  bool is_plausible(Point<DeviceFrame> position) const noexcept;
  bool is_plausible_turn(const device::Rotation& rotation) const noexcept;
  ReadingUse judge_jump(Point<DeviceFrame> position, double dt_s) noexcept;

  double max_speed_m_per_s_;
  double max_turn_rad_per_s_;
  double reach_m_;
  int glitch_readings_;
  bool has_torque_;
  /// Of the device, nominally.
  double period_s_;

  /// Since the last good reading; infinite before the first.
  double since_good_s_ = std::numeric_limits<double>::infinity();
  Point<DeviceFrame> position_;
  device::Rotation rotation_ = device::kNotTurned;
  /// Readings in a row that were not plausible, and how many of the last of them agree about where the hand
  /// is.
  int implausible_ = 0;
  int agreeing_ = 0;
  Point<DeviceFrame> jumped_to_;
};

}  // namespace palpable::haptics
