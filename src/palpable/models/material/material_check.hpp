// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/material/material.hpp"

#include <cmath>

namespace palpable::models {

/// Whether every value is finite and not negative, and the texture is valid: the check for input from files,
/// pages and commands.
inline bool is_valid(const Material& m) {
  for (const double value : {m.stiffness_N_per_m, m.damping_Ns_per_m, m.static_friction, m.dynamic_friction})
    if (!(std::isfinite(value) && value >= 0.0)) return false;
  return is_valid(m.texture);
}

}  // namespace palpable::models
