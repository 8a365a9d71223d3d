// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <algorithm>
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

  /// `resolution_m` >= 0, in metres.
  explicit VelocityEstimator(double resolution_m) : resolution_m_(resolution_m) {}

  /// Forgets the past: the next velocity is 0.
  void begin() noexcept { count_ = 0; }

  /// The velocity in m/s at `position`, reached `dt_s` > 0 after the one before.
  Vector<DeviceFrame> update(Point<DeviceFrame> position, double dt_s) noexcept;

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

/// Where a hand most likely is within its sensor's step. A reading says no more than in which step; within it
/// the hand moves with its estimated velocity. For accounts of energy, where a jump of a whole step under the
/// old force would look like energy that the law made. With resolution 0 it is the reading. Tick path.
class FinePosition {
 public:
  explicit FinePosition(double resolution_m) : half_m_(0.5 * resolution_m) {}

  /// The place after `dt_s`, never more than half a step from `reading` on each axis.
  Point<DeviceFrame> update(Point<DeviceFrame> reading, Vector<DeviceFrame> velocity_m_per_s,
                            double dt_s) noexcept {
    const Vec3 expected = (place_ + dt_s * velocity_m_per_s).v;
    const auto within = [&](double value, double centre) {
      return std::clamp(value, centre - half_m_, centre + half_m_);
    };
    const Vec3 r = reading.v;
    return place_ = {{within(expected.x, r.x), within(expected.y, r.y), within(expected.z, r.z)}};
  }
  Point<DeviceFrame> place() const noexcept { return place_; }

 private:
  double half_m_;
  Point<DeviceFrame> place_;
};

}  // namespace palpable::haptics
