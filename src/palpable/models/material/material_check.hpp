// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/material/material.hpp"

namespace palpable::models {

/// The greatest values of a material, in its units; the least are 0.
inline constexpr double kMostStiffness_N_per_m = 1e6;
inline constexpr double kMostDamping_Ns_per_m = 1e4;
inline constexpr double kMostFriction = 10.0;

/// Whether every value is between 0 and its greatest, and the texture is valid: the check for input from
/// files, pages and commands.
inline bool is_valid(const Material& m) {
  // False for a value that is not a number.
  const auto within = [](double value, double most) { return value >= 0.0 && value <= most; };
  return within(m.stiffness_N_per_m, kMostStiffness_N_per_m) &&
         within(m.damping_Ns_per_m, kMostDamping_Ns_per_m) && within(m.static_friction, kMostFriction) &&
         within(m.dynamic_friction, kMostFriction) && is_valid(m.texture);
}

}  // namespace palpable::models
