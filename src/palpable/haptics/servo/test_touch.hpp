// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the tests of the servo share: analytic surfaces under a plain spring-damper law, and a device that
// gives the readings that a test sets.

#include "palpable/device/device.hpp"
#include "palpable/haptics/law/touchable.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace palpable::haptics {

/// A surface z = height(x, y) with its gradient, felt by a spring along its normal at the point below the
/// hand: the law of a plane is exact, that of a bump or groove good to second order.
class SpringSurface final : public Touchable {
 public:
  struct Height {
    double z_m = 0.0;
    double dzdx = 0.0;
    double dzdy = 0.0;
  };
  using Shape = Height (*)(double x_m, double y_m);

  SpringSurface(Shape shape, double stiffness_N_per_m, double damping_Ns_per_m, std::uint64_t family = 1)
      : shape_(shape), stiffness_(stiffness_N_per_m), damping_(damping_Ns_per_m), family_(family) {}

  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override {
    ++state_as<std::uint64_t>(state);
    const Vec3 p = hand.position.v;
    const Height h = shape_(p.x, p.y);
    const Vec3 normal = unit({-h.dzdx, -h.dzdy, 1.0});
    const double depth_m = (h.z_m - p.z) * normal.z;
    LawOutput output;
    output.stored_J = 0.0;
    if (depth_m <= 0.0) return output;
    output.contact = true;
    output.stored_J = 0.5 * stiffness_ * depth_m * depth_m;
    output.spring_N = {stiffness_ * depth_m * normal};
    const double push_N = stiffness_ * depth_m - damping_ * dot(hand.velocity_m_per_s.v, normal);
    output.force_N = {std::max(0.0, push_N) * normal};
    output.label = p.x > 0.0 ? 1 : 0;
    return output;
  }
  std::uint64_t state_family() const noexcept override { return family_; }
  double damping_Ns_per_m() const noexcept override { return damping_; }
  EnergyModel energy_model() const noexcept override { return EnergyModel::spring; }
  void touch_pages() const noexcept override {}

 private:
  Shape shape_;
  double stiffness_;
  double damping_;
  std::uint64_t family_;
};

inline SpringSurface::Height flat(double, double) { return {}; }
/// The top of a sphere of 40 mm radius, 10 mm above the ground, level around it.
inline SpringSurface::Height bump(double x_m, double y_m) {
  constexpr double kRadius_m = 0.04;
  constexpr double kSunk_m = 0.03;
  const double inside = kRadius_m * kRadius_m - x_m * x_m - y_m * y_m;
  const double up_m = inside > 0.0 ? std::sqrt(inside) : 0.0;
  if (up_m <= kSunk_m) return {};
  return {up_m - kSunk_m, -x_m / up_m, -y_m / up_m};
}
/// A groove along y with walls of 45 degrees.
inline SpringSurface::Height groove(double x_m, double) {
  return {std::abs(x_m), x_m > 0.0 ? 1.0 : -1.0, 0.0};
}

/// Gives the readings that a test sets and keeps what was written.
class ScriptedDevice final : public device::Device {
 public:
  ScriptedDevice() {
    traits_.name = "scripted";
    traits_.max_force_N = 3.0;
    written.reserve(100000);
  }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override { return reading; }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    if (written.size() < written.capacity()) written.push_back(force_N.v);
  }
  void stop() noexcept override { ++stops; }
  device::Traits& mutable_traits() { return traits_; }

  device::Reading reading;
  std::vector<Vec3> written;
  int stops = 0;

 private:
  device::Traits traits_;
};

}  // namespace palpable::haptics
