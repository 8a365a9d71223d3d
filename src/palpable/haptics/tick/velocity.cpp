// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/velocity.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

Vector<DeviceFrame> VelocityEstimator::update(Point<DeviceFrame> position, double dt_s) noexcept {
  // Times are relative to the newest sample, so that they stay small.
  for (int age = 0; age < count_; ++age) times_s_[at(age)] -= dt_s;
  newest_ = (newest_ + 1) % kSamples;
  positions_m_[at(0)] = position.v;
  times_s_[at(0)] = 0.0;
  count_ = std::min(count_ + 1, kSamples);
  if (count_ < 2) return {};
  return {{slope(&Vec3::x), slope(&Vec3::y), slope(&Vec3::z)}};
}

double VelocityEstimator::slope(double Vec3::*axis) noexcept {
  // A reading that goes to and fro by a step is a whole step off the line through its ends. That must not
  // depend on how its numbers are rounded.
  constexpr double kRounding = 1e-6;
  const double fits_m = (1.0 + kRounding) * resolution_m_;
  const double now_m = positions_m_[at(0)].*axis;
  const auto slope_over = [&](int age) { return (now_m - positions_m_[at(age)].*axis) / -times_s_[at(age)]; };
  double best = slope_over(1);
  age_s_.*axis = -0.5 * times_s_[at(1)];
  for (int age = 2; age < count_; ++age) {
    const double line = slope_over(age);
    for (int between = 1; between < age; ++between)
      if (std::abs(now_m + line * times_s_[at(between)] - positions_m_[at(between)].*axis) > fits_m)
        return best;
    best = line;
    age_s_.*axis = -0.5 * times_s_[at(age)];
  }
  return best;
}

}  // namespace palpable::haptics
