// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/material/touch_texture.hpp"

#include <string>

namespace palpable::models {

/// Ratio of dynamic to static friction if only the static coefficient is given.
inline constexpr double kDynamicOfStatic = 5.0 / 6.0;

/// Haptic properties of a surface. The neutral defaults suit a simulated or mid-range device; a device's own
/// limits reduce them.
struct Material {
  std::string name = "default";
  double stiffness_N_per_m = 500.0;
  double damping_Ns_per_m = 0.5;
  double static_friction = 0.3;
  double dynamic_friction = 0.25;
  TouchTexture texture;
};

}  // namespace palpable::models
