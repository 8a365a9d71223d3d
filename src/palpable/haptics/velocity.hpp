// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>

namespace palpable::haptics {

/// Velocity from a quantised position: on each axis the slope over the longest stretch of past samples that
/// one straight line explains to within the sensor's resolution (Janabi-Sharifi, Hayward & Chen 2000,
/// first-order adaptive windowing, end-fit). Fast movement uses the last two samples and adds no delay; slow
/// movement uses up to kSamples and is free of the sensor's steps. With resolution 0 it is the backward
/// difference. Tick path.
class VelocityEstimator {
 public:
  static constexpr int kSamples = 16;

  /// `resolution_m` >= 0, in the units of the positions given to see().
  explicit VelocityEstimator(double resolution_m) : resolution_m_(resolution_m) {}

  /// Forgets the past: the next velocity is 0.
  void begin() noexcept { count_ = 0; }

  /// The velocity at `position`, reached `dt_s` > 0 after the one before.
  Vec3 see(Vec3 position_m, double dt_s) noexcept;

 private:
  double slope(double Vec3::*axis) const noexcept;
  /// `age` samples ago.
  std::size_t at(int age) const noexcept {
    return static_cast<std::size_t>((newest_ + kSamples - age) % kSamples);
  }

  double resolution_m_;
  std::array<Vec3, kSamples> positions_m_{};
  std::array<double, kSamples> times_s_{};
  int newest_ = 0;
  int count_ = 0;
};

}  // namespace palpable::haptics
