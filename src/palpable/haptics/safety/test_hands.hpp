// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Simulated hands of every kind, for the tests of energy and of the stiffness limit.

#include "palpable/device/simulated/simulated_hand.hpp"

#include <cstdint>
#include <random>

namespace palpable::haptics {

/// Draws hands whose masses, stiffnesses and dampings spread over the ranges of docs/devices.md, with sensors
/// of 7 to 64 um and a delay of 0, 1, 2 samples in turn.
class Hands {
 public:
  explicit Hands(std::uint64_t seed) : random_(seed) {}

  double uniform(double least, double most) {
    return least + (most - least) * static_cast<double>(random_() >> 11) * 0x1.0p-53;
  }
  device::HandOptions next() {
    device::HandOptions hand;
    hand.device_mass_kg = uniform(0.05, 0.2);
    hand.arm_mass_kg = uniform(0.0, 0.3);
    hand.arm_stiffness_N_per_m = uniform(50.0, 1000.0);
    hand.arm_damping_Ns_per_m = uniform(2.0, 20.0);
    hand.resolution_m = uniform(7e-6, 64e-6);
    hand.delay_samples = drawn_++ % 3;
    hand.max_force_N = 10.0;
    return hand;
  }

 private:
  std::mt19937_64 random_;
  int drawn_ = 0;
};

}  // namespace palpable::haptics
