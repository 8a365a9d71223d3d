// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::haptics {
namespace {

constexpr double kMargin = 0.9;
/// The share of the virtual damper's dissipation that may compensate the held spring force. The rest is a
/// margin for the damper's errors: its velocity is some ticks old and comes from a quantised sensor. Measured
/// (docs/history): with 0.9, one of twelve random hands received generated energy of some microjoules; with
/// 0.66, none of 600 (palpable_stiffness_set).
constexpr double kHeldMargin = 0.66;
/// The share of the damping of device and hand that a wall's damping may reach, so that both conditions below
/// can hold.
constexpr double kWallsShare = 0.55;

/// What a sensor that is slower than the loop costs. The velocity, too, is half of its period older, so less
/// of the damper's dissipation counts. From a period of 10 ms on, light devices in a stiff hand received
/// energy even so: there the contact's own oscillation must take 42 periods. Measured
/// (docs/history/2026-11-27-fourth-force.md).
constexpr double kSlowShare = 0.85;
constexpr double kSlowest_s = 0.010;
constexpr double kSlowestPhase = 0.15;

bool is_slow(const device::Traits& device, double rate_hz) { return device.sensor_period_s * rate_hz > 1.0; }

/// How long the force of a reading is held, with twice the mean age that the reading has at its first tick.
double hold_s(const device::Traits& device, double rate_hz) {
  return 1.0 / rate_hz + (is_slow(device, rate_hz) ? device.sensor_period_s : 0.0);
}

/// Beyond which a damper whose velocity comes from a very slow sensor no longer holds the device's mass.
double most_by_mass(const device::Traits& device) {
  if (device.sensor_period_s < kSlowest_s || !std::isfinite(device.mass_kg))
    return std::numeric_limits<double>::infinity();
  const double fastest_rad_per_s = kSlowestPhase / device.sensor_period_s;
  return device.mass_kg * fastest_rad_per_s * fastest_rad_per_s;
}

double known_or(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

}  // namespace

SafeContact safe_contact(const device::Traits& device, double rate_hz, double scale, double stiffness_N_per_m,
                         double damping_Ns_per_m, double hand_damping_Ns_per_m) {
  SafeContact safe{stiffness_N_per_m, damping_Ns_per_m, StiffnessBound::none,
                   std::numeric_limits<double>::infinity()};
  if (!device.pushes_back) return safe;
  // In the device frame, a scene of scale s has the stiffness K·s and the damping B·s.
  const double physical = known_or(device.damping_Ns_per_m, 0.0) + hand_damping_Ns_per_m;
  const double held_s = 2.0 * std::max(device.delay_samples, 0) / rate_hz + hold_s(device, rate_hz);
  const double slow = is_slow(device, rate_hz) ? kSlowShare : 1.0;
  const double needed = 0.5 * held_s * stiffness_N_per_m * scale / (slow * kHeldMargin);
  const double damping = std::min(std::max(damping_Ns_per_m * scale, needed), kWallsShare * physical);
  const double friction_N = known_or(device.coulomb_friction_N, 0.0);
  const double step_m = known_or(device.position_resolution_m, 0.0);
  // If friction is unknown, the last condition would forbid every wall, which contradicts practice. So it is
  // not applied.
  const double by_quantisation =
      friction_N > 0.0 && step_m > 0.0 ? 2.0 * friction_N / step_m : std::numeric_limits<double>::infinity();
  struct Candidate {
    double most;
    StiffnessBound bound;
  };
  const Candidate least =
      std::min({Candidate{slow * kHeldMargin * 2.0 * damping / held_s, StiffnessBound::held_spring},
                Candidate{most_by_mass(device), StiffnessBound::held_spring},
                Candidate{slow * kMargin * 2.0 * (physical - damping) / held_s, StiffnessBound::passivity},
                Candidate{kMargin * by_quantisation, StiffnessBound::quantisation}},
               [](const Candidate& a, const Candidate& b) { return a.most < b.most; });
  safe.damping_Ns_per_m = damping / scale;
  safe.max_stiffness_N_per_m = least.most / scale;
  if (stiffness_N_per_m <= safe.max_stiffness_N_per_m) return safe;
  safe.stiffness_N_per_m = safe.max_stiffness_N_per_m;
  safe.bound = least.bound;
  return safe;
}

SafeSlopes safe_slopes(const device::Traits& device, double rate_hz, double scale, double damping_Ns_per_m,
                       double hand_damping_Ns_per_m) {
  // Measured (docs/history/2026-11-24-physics.md): with 0.5, none of 300 hands received more than 0.11 uJ;
  // with 1, two received 1.2 uJ.
  constexpr double kShare = 0.5;
  // At a stiffness that asks for no further damping.
  constexpr double kSoft_N_per_m = 1e-3;
  const auto safe =
      safe_contact(device, rate_hz, scale, kSoft_N_per_m, damping_Ns_per_m, hand_damping_Ns_per_m);
  return {kShare * safe.max_stiffness_N_per_m, device.max_force_N, safe.damping_Ns_per_m};
}

std::string reason(StiffnessBound bound) {
  switch (bound) {
    case StiffnessBound::held_spring:
      return "a stiffer wall at this loop rate, delay and damping would return more energy than it received";
    case StiffnessBound::passivity:
      return "device and hand together damp too little for a stiffer wall at this loop rate and delay";
    case StiffnessBound::quantisation:
      return "a stiffer wall would let the hand feel the steps of the device's sensor";
    case StiffnessBound::none:
      return {};
  }
  return {};
}

}  // namespace palpable::haptics
