// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/velocity.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace palpable::haptics {

Vector<DeviceFrame> VelocityEstimator::update(Point<DeviceFrame> position, double dt_s) noexcept {
  // Times are relative to the newest sample, so that they stay small.
  for (int age = 0; age < count_; ++age) times_s_[at(age)] -= dt_s;
  newest_ = (newest_ + 1) % kSamples;
  positions_m_[at(0)] = position.v;
  times_s_[at(0)] = 0.0;
  count_ = std::min(count_ + 1, kSamples);
  if (count_ < 2) return {};
  std::array<double, kSamples> per_s{};
  for (int age = 1; age < count_; ++age) per_s[static_cast<std::size_t>(age)] = -1.0 / times_s_[at(age)];
  int shortest = 1;
  while (shortest + 1 < count_ && -times_s_[at(shortest)] < shortest_s_) ++shortest;
  return {
      {slope(&Vec3::x, per_s, shortest), slope(&Vec3::y, per_s, shortest), slope(&Vec3::z, per_s, shortest)}};
}

double VelocityEstimator::slope(double Vec3::*axis, const std::array<double, kSamples>& per_s,
                                int shortest) noexcept {
  // A reading that goes to and fro by a step is a whole step off the line through its ends. That must not
  // depend on how its numbers are rounded.
  constexpr double kRounding = 1e-6;
  const double fits_m = (1.0 + kRounding) * resolution_m_;
  const double now_m = positions_m_[at(0)].*axis;
  const auto rise_m = [&](int age) { return now_m - positions_m_[at(age)].*axis; };
  // The slopes of lines through the newest sample that pass the samples after the oldest one closely enough.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  int oldest = shortest;
  for (int age = shortest + 1; age < count_; ++age) {
    const double between_m = rise_m(age - 1);
    const double between_per_s = per_s[static_cast<std::size_t>(age - 1)];
    least = std::max(least, (between_m - fits_m) * between_per_s);
    most = std::min(most, (between_m + fits_m) * between_per_s);
    const double line = rise_m(age) * per_s[static_cast<std::size_t>(age)];
    if (line < least || line > most) break;
    oldest = age;
  }
  age_s_.*axis = -0.5 * times_s_[at(oldest)];
  return rise_m(oldest) / -times_s_[at(oldest)];
}

}  // namespace palpable::haptics
