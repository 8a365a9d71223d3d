// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/url.hpp"

#include <limits>

namespace palpable::device {

/// Not stated.
inline constexpr double kNoForce_N = std::numeric_limits<double>::quiet_NaN();

/// The option `continuous-force` of a device's address, N, 0.1 to 40; kNoForce_N if it has none.
inline double take_continuous_force(DeviceUrl& url) {
  return url.take_number("continuous-force", kNoForce_N, 0.1, 40.0);
}

/// Traits::continuous_force_N of a device whose maker does not state it: what was asked for, else half of the
/// greatest force (a quarter of its heat). That half is an assumption.
inline double continuous_force(double asked_N, double max_force_N) {
  return asked_N > 0.0 ? asked_N : 0.5 * max_force_N;
}

}  // namespace palpable::device
