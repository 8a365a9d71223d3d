// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/haptics/tick/servo_types.hpp"

#include <memory>
#include <optional>
#include <span>

namespace palpable::haptics {

/// Short force pulses along each axis in turn, in both directions, on a device that a hand holds in free air.
struct PulseOptions {
  /// Peak force of a pulse (half a sine), limited to a third of the device's greatest force.
  double pulse_N = 0.8;
  double pulse_s = 0.06;
  /// Time between the starts of two pulses, and the length of the response that is fitted. After that the
  /// hand is slow, and the device's friction holds it with an unknown force.
  double every_s = 0.4;
  double fitted_s = 0.15;
  int pulses = 18;
  /// Time before the first pulse.
  double settling_s = 0.6;

  double duration_s() const noexcept { return settling_s + every_s * pulses; }
};

/// Impedance of device and hand along one axis: m x'' + b x' + k x = F.
struct Impedance {
  double mass_kg = 0.0;
  double damping_Ns_per_m = 0.0;
  double stiffness_N_per_m = 0.0;
};

/// The damping that a hand adds to a device, from all pulses that could be fitted.
struct MeasuredHand {
  int pulses = 0;
  /// Medians of device and hand together.
  Impedance together;
  /// The hand alone, the device's damping subtracted: minimum, median and maximum of all pulses.
  double least_damping_Ns_per_m = 0.0;
  double median_damping_Ns_per_m = 0.0;
  double greatest_damping_Ns_per_m = 0.0;
};

/// One tick on one axis: the position at its start, and the force that acts until the next tick.
struct PushedSample {
  double position_m = 0.0;
  double force_N = 0.0;
  double dt_s = 0.001;
};

/// Fits mass, damping and stiffness to a response by linear least squares. The equation of motion is
/// integrated twice, so that no derivative of the position is needed. A constant force and the initial
/// velocity are fitted too. nullopt: too few samples, or a singular system.
std::optional<Impedance> fit_impedance(std::span<const PushedSample> samples);

/// A law that renders the pulses at any position. It has no potential and generates energy on purpose; its
/// force is at most pulse_N.
std::shared_ptr<const Touchable> make_pulses(const PulseOptions& options, const device::Traits& device);

/// Estimates the hand's damping from the samples of a touch of make_pulses(). The delay, damping and friction
/// of `device` are compensated where they are known. Errors (failed): no pulse could be fitted.
Result<MeasuredHand> hand_of(std::span<const TouchSample> samples, const device::Traits& device,
                             const PulseOptions& options);

/// Runs the pulses on a device in real time, in a servo loop with its limits; blocks for duration_s().
/// Errors: as ServoLoop::start() and hand_of(); device, if it fails meanwhile; usage for a device without
/// motors.
Result<MeasuredHand> measure_hand(std::unique_ptr<device::Device> device, const PulseOptions& options);

}  // namespace palpable::haptics
