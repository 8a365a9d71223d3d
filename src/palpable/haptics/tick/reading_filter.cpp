// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/reading_filter.hpp"

#include "palpable/haptics/tick/rotation.hpp"
#include "palpable/haptics/tick/servo_types.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

ReadingFilter::ReadingFilter(const device::Traits& device, const TickOptions& options) noexcept
    : max_speed_m_per_s_(device.pushes_back ? options.max_speed_m_per_s : options.max_pointer_speed_m_per_s),
      max_rotation_rad_per_s_(options.max_rotation_rad_per_s),
      reach_m_(options.reach_in_workspaces * norm(device.workspace_m)),
      glitch_readings_(options.glitch_readings),
      has_torque_(device.has_torque),
      rate_(device),
      period_s_(1.0 / (std::isfinite(device.rate_hz) ? std::max(device.rate_hz, 1.0) : 1000.0)) {}

JudgedReading ReadingFilter::judge(const device::Reading& reading, double dt_s) noexcept {
  since_good_s_ += dt_s;
  if (reading.status != device::Status::ok) return {};
  if (has_torque_ && !is_rotation(reading.rotation)) return {ReadingUse::none, true};
  const Point<DeviceFrame> position = reading.position;
  // A recorded tick tells what it was taken for.
  const bool is_slow = rate_.repeats(position);
  const bool repeats = reading.recorded ? (reading.recorded->flags & flag::kRepeated) != 0
                                        : (is_slow || reading.is_repeated) && agreeing_ == 0;
  if (repeats && std::isfinite(since_good_s_)) return {ReadingUse::repeated};
  JudgedReading judged{ReadingUse::continues, false, !std::isfinite(since_good_s_), since_good_s_};
  const bool plausible = judged.first ? is_in_reach(position)
                                      : is_plausible(position) && is_plausible_rotation(reading.rotation);
  if (!plausible) {
    judged.use = judge_jump(position, dt_s);
    judged.first = true;
    if (!judged.is_good()) {
      judged.implausible = true;
      return judged;
    }
  }
  if (judged.first) {
    judged.passed_s = dt_s;
    velocity_m_per_s_ = {};
  } else if (implausible_ == 0) {
    velocity_m_per_s_ = (1.0 / since_good_s_) * (position - position_);
  }
  implausible_ = 0;
  agreeing_ = 0;
  since_good_s_ = 0.0;
  position_ = position;
  rotation_ = reading.rotation;
  return judged;
}

bool ReadingFilter::is_in_reach(Point<DeviceFrame> position) const noexcept {
  return is_finite(position) && norm(position.v) <= reach_m_;
}

bool ReadingFilter::is_plausible(Point<DeviceFrame> position) const noexcept {
  if (!is_in_reach(position)) return false;
  const double from_last_m = norm(position - position_);
  // A late tick may be followed by an early one: the device has still moved for a full period.
  if (from_last_m > max_speed_m_per_s_ * std::max(since_good_s_, period_s_)) return false;
  if (implausible_ > 0 && !is_where_the_hand_was_going(position)) return false;
  // The jump persists if the reading is nearer to the new position than to the old one.
  return agreeing_ == 0 || norm(position - jumped_to_) >= from_last_m;
}

bool ReadingFilter::is_where_the_hand_was_going(Point<DeviceFrame> position) const noexcept {
  // Half of the longest way in a period, however long readings were nonsense: meanwhile a hand may have gone
  // far, but a single reading among them is no proof of it.
  const double most_m = 0.5 * max_speed_m_per_s_ * period_s_;
  return norm(position - position_) <= most_m ||
         norm(position - (position_ + since_good_s_ * velocity_m_per_s_)) <= most_m;
}

bool ReadingFilter::is_plausible_rotation(const device::Rotation& rotation) const noexcept {
  return !has_torque_ ||
         norm(rotation_between(rotation_, rotation)) <= max_rotation_rad_per_s_ * since_good_s_;
}

ReadingUse ReadingFilter::judge_jump(Point<DeviceFrame> position, double dt_s) noexcept {
  ++implausible_;
  const bool in_reach = is_in_reach(position);
  const bool agrees = in_reach && (agreeing_ == 0 || norm(position - jumped_to_) <=
                                                         max_speed_m_per_s_ * std::max(dt_s, period_s_));
  agreeing_ = agrees ? agreeing_ + 1 : (in_reach ? 1 : 0);
  jumped_to_ = position;
  if (agreeing_ > glitch_readings_) return ReadingUse::new_touch;
  // Before the first valid reading there is no force to hold.
  return implausible_ <= glitch_readings_ && std::isfinite(since_good_s_) ? ReadingUse::glitch
                                                                          : ReadingUse::none;
}

}  // namespace palpable::haptics
