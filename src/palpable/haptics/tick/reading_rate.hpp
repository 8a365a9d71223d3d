// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Finds a device that gives new readings more slowly than the loop asks for them, at its own rate or in
/// bursts: while the hand moves, its reading stays equal for some ticks and then goes on by more than two
/// steps of the sensor. A hand that moves slowly changes a coarse reading by one step at a time, so it is not
/// mistaken for that. A repeated reading says nothing about the hand: taken for a hand at rest, it makes the
/// velocity zero in one tick and several times too high in the next. Devices without motors are not examined.
/// Tick path; no allocation.
class ReadingRate {
 public:
  /// Readings that are more ticks apart are not examined.
  static constexpr int kMostTicks = 16;

  explicit ReadingRate(const device::Traits& device) noexcept
      : far_m_(std::isfinite(device.position_resolution_m) ? 2.5 * device.position_resolution_m : 0.0),
        is_examined_(device.pushes_back) {}

  /// Takes the position of a reading. Whether it is only the reading before, given again by a device that is
  /// known to do so.
  bool repeats(Point<DeviceFrame> position) noexcept {
    if (!is_examined_) return false;
    const Vec3 moved = (position - before_).v;
    before_ = position;
    ++since_new_;
    if (moved == Vec3{}) return gaps_ >= kKnown && since_new_ % slowest_ != 0;
    const double most_m = std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)});
    // Flicker by up to four steps may cancel a movement in one tick and double it in the next.
    const double far_m = since_new_ == 2 ? 4.0 * far_m_ : far_m_;
    const bool moves = most_m > std::max(far_m, kLeast_m * since_new_);
    // A reading that goes to and fro between two places shows no rate.
    if (moves && moved_before_ && dot(moved, moved_) >= 0.0) examine(since_new_);
    moved_before_ = moves;
    moved_ = moved;
    since_new_ = 0;
    return false;
  }

  /// The most ticks that pass between two readings of the device, 1 ... kMostTicks; 1 also where hardly any
  /// tick is without a new reading.
  int ticks() const noexcept { return gaps_ >= kKnown && often_ > kOften ? slowest_ : 1; }

 private:
  /// A hand that moves less in a tick may have been at rest meanwhile.
  static constexpr double kLeast_m = 5e-6;
  /// So many gaps make a device known for them; so many readings without one let it be forgotten.
  static constexpr int kKnown = 3;
  static constexpr int kForgotten = 500;
  /// The share of the last ticks of a moving hand, about so many, that belong to gaps.
  static constexpr double kOften = 0.1;
  static constexpr double kLast_ticks = 32.0;

  /// A new reading of a moving hand, so many ticks after the last one.
  void examine(int after) noexcept {
    if (after > kMostTicks) return;
    const bool is_gap = after > 1;
    often_ += after / kLast_ticks * ((is_gap ? 1.0 : 0.0) - often_);
    without_gap_ = is_gap ? 0 : std::min(without_gap_ + 1, kForgotten);
    if (without_gap_ >= kForgotten) gaps_ = 0;
    if (gaps_ == 0) slowest_ = 1;
    if (!is_gap) return;
    gaps_ = std::min(gaps_ + 1, kKnown);
    slowest_ = std::max(slowest_, after);
  }

  double far_m_;
  bool is_examined_;
  Point<DeviceFrame> before_;
  /// By the last new reading, and whether the hand moved then.
  Vec3 moved_;
  bool moved_before_ = false;
  int since_new_ = 0;
  int gaps_ = 0;
  int without_gap_ = 0;
  int slowest_ = 1;
  double often_ = 0.0;
};

}  // namespace palpable::haptics
