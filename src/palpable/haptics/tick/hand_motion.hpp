// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/haptics/tick/tick_options.hpp"
#include "palpable/haptics/tick/velocity.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// What a law learns about a hand's motion from its readings: the velocity, its expected change until the
/// force acts, and when that is. The tick and whoever recomputes a law (session/check) feed the same class,
/// so that both give a law the same. Tick path; no allocation.
class HandMotion {
 public:
  HandMotion(const device::Traits& device, const TickOptions& options)
      : velocity_(known_or_zero(device.position_resolution_m), shortest_window_s(options)),
        gain_(device.delay_samples),
        delay_ticks_(std::clamp(device.delay_samples, 0, VelocityGain::kMostDelay)),
        sensor_period_s_(known_or_zero(device.sensor_period_s)),
        max_step_s_(options.max_rise_time_s) {}

  /// Earlier readings say nothing about the next one: a new touch, or a stall.
  void begin() noexcept {
    velocity_.begin();
    gain_.begin();
    gains_m_per_s_ = {};
  }
  /// A valid reading, `passed_s` after the last valid one.
  void update(Point<DeviceFrame> position, double passed_s) noexcept {
    velocity_m_per_s_ = velocity_.update(position, passed_s);
    gains_m_per_s_ = gain_.update(velocity_m_per_s_, velocity_.age_s(), acts_after_s(passed_s), passed_s);
  }

  /// At the last valid reading.
  Vector<DeviceFrame> velocity_m_per_s() const noexcept { return velocity_m_per_s_; }
  /// Hand::gains_m_per_s.
  Vector<DeviceFrame> gains_m_per_s() const noexcept { return gains_m_per_s_; }
  /// Hand::acts_after_s in a tick of this length.
  double acts_after_s(double dt_s) const noexcept {
    const double tick_s = std::min(dt_s, max_step_s_);
    // The mean age of a reading while its force is held.
    const double held_s = sensor_period_s_ > tick_s ? sensor_period_s_ + tick_s : tick_s;
    return static_cast<double>(delay_ticks_) * tick_s + 0.5 * held_s;
  }

 private:
  static double known_or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

  VelocityEstimator velocity_;
  VelocityGain gain_;
  int delay_ticks_;
  double sensor_period_s_;
  double max_step_s_;
  Vector<DeviceFrame> velocity_m_per_s_;
  Vector<DeviceFrame> gains_m_per_s_;
};

}  // namespace palpable::haptics
