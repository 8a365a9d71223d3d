// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/haptics/tick/reading_rate.hpp"
#include "palpable/haptics/tick/tick_options.hpp"

#include <limits>

namespace palpable::haptics {

/// How a reading is used.
enum class ReadingUse {
  /// The touch continues at the new position.
  continues,
  /// The hand is at the new position but did not move there continuously: a new touch begins.
  new_touch,
  /// Not plausible, and it is not yet known whether the position persists: the force is held.
  glitch,
  /// The reading before, given again by a device that says so or is slower than the loop: the force is held,
  /// since a way of several ticks would count as that of one, and damper and energy balance with it.
  repeated,
  /// No position is known: the force ramps down to zero.
  none
};

/// The classification of one reading.
struct JudgedReading {
  ReadingUse use = ReadingUse::none;
  /// The reading was not finite, was out of reach, or moved or turned faster than a hand can.
  bool implausible = false;
  /// There was no valid reading before it, or it begins a new touch.
  bool first = false;
  /// Time since the last valid reading, seconds; for the first one the time since the previous tick.
  double passed_s = 0.0;

  bool is_good() const noexcept { return use == ReadingUse::continues || use == ReadingUse::new_touch; }
};

/// Decides which readings of a device are movements of a hand. A hand moves at no more than
/// TickOptions::max_speed_m_per_s. A faster reading is treated as a glitch for TickOptions::glitch_readings
/// ticks. If the following readings agree with it, the hand is there, and a new touch begins. Readings that
/// agree with no other reading are not used: after one that was not used, a single reading continues the
/// touch only near the place to which the hand's last velocity leads. Tick path; no allocation.
class ReadingFilter {
 public:
  ReadingFilter(const device::Traits& device, const TickOptions& options) noexcept;

  /// Classifies a reading that comes `dt_s` > 0 after the previous one.
  JudgedReading judge(const device::Reading& reading, double dt_s) noexcept;

  /// ReadingRate::ticks().
  int ticks() const noexcept { return rate_.ticks(); }

 private:
  bool is_in_reach(Point<DeviceFrame> position) const noexcept;
  bool is_plausible(Point<DeviceFrame> position) const noexcept;
  bool is_where_the_hand_was_going(Point<DeviceFrame> position) const noexcept;
  bool is_plausible_rotation(const device::Rotation& rotation) const noexcept;
  ReadingUse judge_jump(Point<DeviceFrame> position, double dt_s) noexcept;

  double max_speed_m_per_s_;
  double max_rotation_rad_per_s_;
  double reach_m_;
  int glitch_readings_;
  bool has_torque_;
  ReadingRate rate_;
  /// Nominal period of the device.
  double period_s_;

  /// Time since the last valid reading; infinite before the first.
  double since_good_s_ = std::numeric_limits<double>::infinity();
  Point<DeviceFrame> position_;
  /// Over the last two valid readings between which none was implausible.
  Vector<DeviceFrame> velocity_m_per_s_;
  device::Rotation rotation_ = device::kIdentityRotation;
  /// Consecutive readings that were not plausible, and how many of the newest of them agree about the
  /// position.
  int implausible_ = 0;
  int agreeing_ = 0;
  Point<DeviceFrame> jumped_to_;
};

}  // namespace palpable::haptics
