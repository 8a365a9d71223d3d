// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/material/material.hpp"

#include <cmath>

namespace palpable::models {

/// Every number of it finite, none negative, and its texture sound: what a file, a page or a command may
/// give.
inline bool is_sound(const Material& m) {
  for (const double value : {m.stiffness_N_per_m, m.damping_Ns_per_m, m.static_friction, m.dynamic_friction})
    if (!(std::isfinite(value) && value >= 0.0)) return false;
  return is_sound(m.texture);
}

}  // namespace palpable::models
