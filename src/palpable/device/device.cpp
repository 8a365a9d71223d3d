// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/device.hpp"

#include <cmath>

namespace palpable::device {
namespace {

bool is_amount(double value) { return std::isfinite(value) && value > 0.0; }
bool is_unknown_or_finite(double value) {
  return std::isnan(value) || (std::isfinite(value) && value >= 0.0);
}

}  // namespace

Result<void> check(const Traits& traits) {
  const auto usage = [](const char* message) { return Error{ErrorCode::usage, message, {}}; };
  if (traits.degrees_of_freedom != 2 && traits.degrees_of_freedom != 3)
    return usage("a device has 2 or 3 degrees of freedom");
  const Vec3& size = traits.workspace_m;
  if (!is_amount(size.x) || !is_amount(size.y) || !is_amount(size.z))
    return usage("a device's workspace must be above 0 m on every axis");
  if (!is_amount(traits.max_force_N)) return usage("a device's greatest force must be above 0 N and finite");
  if (traits.has_torque && !is_amount(traits.max_torque_Nm))
    return usage("the greatest torque of a device with torque must be above 0 Nm and finite");
  if (traits.delay_samples < 0) return usage("a device's delay must be at least 0 samples");
  for (const double value :
       {traits.mass_kg, traits.damping_Ns_per_m, traits.coulomb_friction_N, traits.position_resolution_m,
        traits.inertia_kg_m2, traits.rotational_damping_Nm_s})
    if (!is_unknown_or_finite(value))
      return usage(
          "a device's mass, damping, friction, resolution and inertia must be at least 0 or unknown");
  if (!std::isnan(traits.rate_hz) && !is_amount(traits.rate_hz))
    return usage("a device's rate must be above 0 Hz or unknown");
  return {};
}

}  // namespace palpable::device
