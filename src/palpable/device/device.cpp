// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/device.hpp"

#include "palpable/core/text/figure.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace palpable::device {
namespace {

/// A number of the traits and the range that every device is within with a wide margin: the strongest
/// grounded devices for a hand give 250 N. Values outside are a fault, or were written by hand.
struct Range {
  const char* words;
  double Traits::*value;
  double least;
  double most;
};

constexpr double kLeastForce_N = 1e-6, kMostForce_N = 250.0, kMostTorque_Nm = 100.0;
/// May be unknown (NaN).
constexpr Range kMeasured[]{
    {"continuous force (N)", &Traits::continuous_force_N, kLeastForce_N, kMostForce_N},
    {"mass (kg)", &Traits::mass_kg, 1e-6, 100.0},
    {"damping (N·s/m)", &Traits::damping_Ns_per_m, 0.0, 1e4},
    {"friction (N)", &Traits::coulomb_friction_N, 0.0, 250.0},
    {"resolution (m)", &Traits::position_resolution_m, 0.0, 0.1},
    {"inertia (kg·m²)", &Traits::inertia_kg_m2, 0.0, 10.0},
    {"rotational damping (N·m·s)", &Traits::rotational_damping_Nm_s, 0.0, 100.0},
    {"rate (Hz)", &Traits::rate_hz, 1e-3, 1e6},
    {"sensor's period (s)", &Traits::sensor_period_s, 0.0, 1.0}};
constexpr double kLeastSize_m = 1e-6, kMostSize_m = 100.0;
constexpr int kMostDelay = 10'000;

bool is_within(double value, double least, double most) { return value >= least && value <= most; }

Error usage(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

Error out_of(const char* what, double least, double most) {
  return usage(std::string("a device's ") + what + " must be " + figure(least) + " to " + figure(most));
}

}  // namespace

Result<void> check(const Traits& traits) {
  if (traits.degrees_of_freedom != 2 && traits.degrees_of_freedom != 3)
    return usage("a device has 2 or 3 degrees of freedom");
  const Vec3& size = traits.workspace_m;
  for (const double side : {size.x, size.y, size.z})
    if (!is_within(side, kLeastSize_m, kMostSize_m))
      return out_of("workspace (m)", kLeastSize_m, kMostSize_m);
  if (!is_within(traits.max_force_N, kLeastForce_N, kMostForce_N))
    return out_of("greatest force (N)", kLeastForce_N, kMostForce_N);
  const bool has_valid_torque = traits.has_torque ? is_within(traits.max_torque_Nm, 1e-9, kMostTorque_Nm)
                                                  : is_within(traits.max_torque_Nm, 0.0, kMostTorque_Nm);
  if (!has_valid_torque) return out_of("greatest torque (N·m)", 0.0, kMostTorque_Nm);
  if (traits.delay_samples < 0 || traits.delay_samples > kMostDelay)
    return out_of("delay in samples", 0.0, kMostDelay);
  for (const Range& range : kMeasured)
    if (const double value = traits.*range.value;
        !std::isnan(value) && !is_within(value, range.least, range.most))
      return out_of(range.words, range.least, range.most);
  return {};
}

}  // namespace palpable::device
