// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Devices whose readings are slower than the loop: softer springs, and the work of forces between two
// readings.
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <utility>

namespace palpable::haptics {

double TickPipeline::safe_spring_share() const noexcept {
  double share = 1.0;
  const auto limit = [&](const Side& side) {
    const double spring_N = norm(side.output.spring_N);
    if (!(spring_N > 0.0) || !(side.output.stored_J > 0.0)) return;
    const double scale = side.scene->scene_from_device.scale;
    HeldContact contact;
    // A spring that stores U at a force f has the stiffness f² / 2 U.
    contact.stiffness_N_per_m = scale * spring_N * spring_N / (2.0 * side.output.stored_J);
    contact.damping_Ns_per_m = scale * side.scene->touchable->damping_Ns_per_m();
    contact.delay = static_cast<int>(delay_);
    contact.ticks_per_reading = readings_.ticks();
    // max_rise_time_s is one and a half periods.
    contact.period_s = options_.max_rise_time_s / 1.5;
    share = std::min(share, slow_reading_share(contact));
  };
  limit(now_);
  if (fading()) limit(coming_);
  return share;
}

void TickPipeline::soften(double dt_s) noexcept {
  if (readings_.ticks() == 1 && spring_share_ >= 1.0) {
    contact_begins_ = false;
    return;
  }
  if (is_free()) {
    spring_share_ = 1.0;
    contact_begins_ = true;
    return;
  }
  // A spring that becomes weaker under a hand returns less than it received; it would make energy if it
  // became stronger.
  const double most_less = contact_begins_ ? 1.0 : dt_s / options_.ramp_up_s;
  if (is_accounted())
    spring_share_ = std::clamp(safe_spring_share(), std::max(0.0, spring_share_ - most_less), spring_share_);
  contact_begins_ = false;
  if (spring_share_ >= 1.0) return;
  const Vector<DeviceFrame> spring_N = potential(faded_).uncapped_N;
  const Vector<DeviceFrame> rest_N = law_force_N_ - (1.0 / spring_share_) * spring_N;
  law_force_N_ = with_spring(spring_N, rest_N, law_force_N_);
  if (!has_torque_) return;
  const Vector<DeviceFrame> spring_Nm =
      blended([this](const Side& side) { return device_torque_Nm(side, side.output.spring_torque_Nm); });
  law_torque_Nm_ = law_torque_Nm_ - (1.0 - spring_share_) * spring_Nm;
}

void TickPipeline::average_held(bool has_reading) noexcept {
  const int ticks_without = std::exchange(ticks_without_, has_reading ? 0 : ticks_without_ + 1);
  has_mean_ = has_reading && ticks_without > 0;
  if (!has_mean_) return;
  const auto kept = static_cast<int>(sent_.size() - delay_);
  const int ticks = std::min(ticks_without + 1, kept);
  const double share = 1.0 / ticks;
  mean_ = {};
  for (int age = 0; age < ticks; ++age) {
    const Sent& sent =
        sent_[(newest_ + 2 * sent_.size() - delay_ - static_cast<std::size_t>(age)) % sent_.size()];
    mean_.written_N += share * sent.written_N;
    mean_.uncontrolled_N += share * sent.uncontrolled_N;
    mean_.written_Nm += share * sent.written_Nm;
    mean_.uncontrolled_Nm += share * sent.uncontrolled_Nm;
    mean_.guide_N += share * sent.guide_N;
    mean_.weakened = mean_.weakened || sent.weakened;
  }
}

}  // namespace palpable::haptics
