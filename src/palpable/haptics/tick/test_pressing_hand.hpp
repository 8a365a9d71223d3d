// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

namespace palpable::haptics {

/// A hand of 100 g that presses with 0.6 N and has the damping of an arm, but does not steer.
class PressingHand final : public device::Device {
 public:
  explicit PressingHand(Vec3 start) : place_(start) {
    traits_.name = "pressing hand";
    traits_.position_resolution_m = 0.0;
    traits_.workspace_m = {0.2, 0.2, 0.1};
  }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    constexpr double kMass_kg = 0.1, kDamping_Ns_per_m = 3.0, kPress_N = 0.6, kStep_s = 1e-4;
    constexpr int kSteps = 10;
    for (int k = 0; k < kSteps; ++k) {
      const Vec3 force = force_ - kDamping_Ns_per_m * speed_ + Vec3{0.0, 0.0, -kPress_N};
      speed_ = speed_ + kStep_s / kMass_kg * force;
      place_ = place_ + kStep_s * speed_;
    }
    device::Reading reading;
    reading.position = {place_};
    return reading;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override { force_ = force_N.v; }
  void stop() noexcept override { force_ = {}; }
  Vec3 place() const { return place_; }

 private:
  device::Traits traits_;
  Vec3 place_, speed_, force_;
};

}  // namespace palpable::haptics
