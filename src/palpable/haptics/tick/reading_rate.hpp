// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Finds a device that gives new readings more slowly than the loop asks for them: its reading stays equal
/// for some ticks and then moves by more than two steps of the sensor, several times in succession. A hand
/// that moves slowly changes a coarse reading by one step at a time, so it is not mistaken for that. A
/// repeated reading says nothing about the hand: taken for a hand at rest, it makes the velocity zero in
/// one tick and several times too high in the next. Devices without motors are not examined. Tick path; no
/// allocation.
class ReadingRate {
 public:
  /// The slowest device that is recognised gives a reading in each so many ticks.
  static constexpr int kMostTicks = 10;

  explicit ReadingRate(const device::Traits& device) noexcept
      : far_m_(std::isfinite(device.position_resolution_m) ? 2.5 * device.position_resolution_m : 0.0),
        is_examined_(device.pushes_back) {}

  /// Takes the position of a reading. Whether it is only the reading before, given again by a device that is
  /// known to be slower than the loop.
  bool repeats(Point<DeviceFrame> position) noexcept {
    if (!is_examined_) return false;
    const Vec3 moved = (position - before_).v;
    before_ = position;
    ++since_new_;
    if (moved == Vec3{}) return ticks_ > 1 && since_new_ % ticks_ != 0;
    const double most_m = std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)});
    if (most_m > far_m_) examine(since_new_);
    since_new_ = 0;
    return false;
  }

  /// How many ticks pass between two readings of the device, as far as known: 1 ... kMostTicks.
  int ticks() const noexcept { return ticks_; }

 private:
  /// A new reading, so many ticks after the last one.
  void examine(int after) noexcept {
    constexpr int kAlike = 3;
    const bool is_slow = after > 1 && after <= kMostTicks;
    alike_ = is_slow == were_slow_ ? alike_ + 1 : 1;
    slowest_ = is_slow ? (alike_ == 1 ? after : std::max(slowest_, after)) : 1;
    were_slow_ = is_slow;
    // A hand that begins to move after a rest is no sign of a fast device.
    if (after > kMostTicks) alike_ = 0;
    if (alike_ >= kAlike) ticks_ = slowest_;
  }

  double far_m_;
  bool is_examined_;
  Point<DeviceFrame> before_;
  int since_new_ = 0;
  int alike_ = 0;
  int slowest_ = 1;
  bool were_slow_ = false;
  int ticks_ = 1;
};

}  // namespace palpable::haptics
