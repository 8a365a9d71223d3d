// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/haptics/servo/servo_types.hpp"

#include <memory>
#include <optional>
#include <span>

namespace palpable::haptics {

/// Short pulses of force along each axis in turn, to and fro, on a hand that holds a device in free air.
struct PulseOptions {
  /// Greatest force of a pulse (half a sine); lowered to a third of the device's.
  double pulse_N = 0.8;
  double pulse_s = 0.06;
  /// From one pulse's begin to the next one's; and how much of the response is fitted. Later the hand is
  /// slow, and the device's friction holds it with an unknown force.
  double every_s = 0.4;
  double fitted_s = 0.15;
  int pulses = 18;
  /// Before the first one.
  double settling_s = 0.6;

  double duration_s() const noexcept { return settling_s + every_s * pulses; }
};

/// Device and hand along one axis: m x'' + b x' + k x = F.
struct Impedance {
  double mass_kg = 0.0;
  double damping_Ns_per_m = 0.0;
  double stiffness_N_per_m = 0.0;
};

/// What a hand adds to a device's damping, over all pulses that could be fitted.
struct MeasuredHand {
  int pulses = 0;
  /// Medians, device and hand together.
  Impedance together;
  /// Without the device's own damping: the least, the median and the greatest of all pulses.
  double least_damping_Ns_per_m = 0.0;
  double median_damping_Ns_per_m = 0.0;
  double greatest_damping_Ns_per_m = 0.0;
};

/// One tick on one axis: the position at its begin, and the force that acted until the next.
struct PushedSample {
  double position_m = 0.0;
  double force_N = 0.0;
  double dt_s = 0.001;
};

/// Fits mass, damping and stiffness to a response by linear least squares on the twice integrated equation,
/// which needs no derivative of the position; a constant force and velocity at the start are fitted too.
/// nullopt: too few samples, or a response that determines nothing.
std::optional<Impedance> fit_impedance(std::span<const PushedSample> samples);

/// Renders the pulses wherever the hand is. It is a law without a potential that gives energy on purpose, at
/// most pulse_N.
std::shared_ptr<const Touchable> make_pulses(const PulseOptions& options, const device::Traits& device);

/// What the samples of a touch of make_pulses() say of the hand. `device` gives delay, damping and friction,
/// which are taken off where they are known. Errors (failed): no pulse could be fitted.
Result<MeasuredHand> hand_of(std::span<const TouchSample> samples, const device::Traits& device,
                             const PulseOptions& options);

/// Runs the pulses on a device in real time, in a servo loop with its limits. Errors: as ServoLoop::start()
/// and hand_of(); device, where it fails meanwhile; usage for a device without motors.
Result<MeasuredHand> measure_hand(std::unique_ptr<device::Device> device, const PulseOptions& options);

}  // namespace palpable::haptics
