// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// The heat of a device's motors, as far as forces tell: current, and so force, heats a winding by its
/// square, and a winding cools as a system of first order does (h' = (F² - h) / time). A force that is
/// written for ever may be `continuous_N` at most; a greater one, up to `max_N`, for a while. When four
/// fifths of the heat of the continuous force are reached the greatest force begins to fall, and it reaches
/// the continuous force with the whole of it. It falls and comes back within seconds, so it makes no step.
/// Tick path.
class HeatBudget {
 public:
  /// Of the winding of a small motor; makers of devices do not state it, and no hardware has confirmed it.
  static constexpr double kTime_s = 30.0;
  static constexpr double kBegin = 0.8;

  /// `continuous_N`: NaN, or not below `max_N`: max_N may be written for ever. `heat` 0 ... 1: of the motors
  /// at the beginning.
  HeatBudget(double max_N, double continuous_N, double heat = 0.0) noexcept
      : max_N2_(max_N * max_N), continuous_N2_(continuous_N * continuous_N), cap_N_(max_N) {
    if (!(continuous_N < max_N)) return;
    is_bounded_ = true;
    heat_N2_ = std::clamp(heat, 0.0, 1.0) * continuous_N2_;
    update();
  }

  /// The greatest force that may be written now, N.
  double cap_N() const noexcept { return cap_N_; }
  /// It is below the device's greatest by a tenth or more.
  bool is_warm() const noexcept { return cap_N_ * cap_N_ < 0.81 * max_N2_; }
  /// 0 ... 1: the part of the heat that the continuous force makes in the end.
  double heat() const noexcept { return is_bounded_ ? heat_N2_ / continuous_N2_ : 0.0; }

  /// A force of this squared size, N², has been written for `dt_s` > 0.
  void add(double force_N2, double dt_s) noexcept {
    if (!is_bounded_) return;
    // Implicit Euler: exact to dt / time, and stable for any dt.
    heat_N2_ += (force_N2 - heat_N2_) * (dt_s / (kTime_s + dt_s));
    update();
  }

 private:
  void update() noexcept {
    const double left = std::clamp((1.0 - heat_N2_ / continuous_N2_) / (1.0 - kBegin), 0.0, 1.0);
    cap_N_ = std::sqrt(continuous_N2_ + left * (max_N2_ - continuous_N2_));
  }

  double max_N2_;
  double continuous_N2_;
  double cap_N_;
  double heat_N2_ = 0.0;
  bool is_bounded_ = false;
};

}  // namespace palpable::haptics
