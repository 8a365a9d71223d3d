// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A hand that turns by itself within a few ticks of contact: the forces of its way in act on its way out. Its
// path is prescribed, so that what it receives is known.
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kGround_m = 0.005;

/// A device that is moved along a path, whatever its motors do.
class GuidedDevice final : public device::Device {
 public:
  GuidedDevice(int delay, double step_m) : step_m_(step_m), on_the_way_N_(static_cast<std::size_t>(delay)) {
    traits_.name = "guided";
    traits_.damping_Ns_per_m = 0.1;
    traits_.position_resolution_m = step_m;
    traits_.delay_samples = delay;
    traits_.max_force_N = 10.0;
    traits_.mass_kg = 0.1;
  }

  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    device::Reading reading;
    reading.position.v = {0.0, 0.0, step_m_ * std::round(z_m_ / step_m_)};
    return reading;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    on_the_way_N_.push_back(force_N.v.z);
    acts_N_ = on_the_way_N_.front();
    on_the_way_N_.pop_front();
  }
  void stop() noexcept override {}

  /// Moves to the next height while the motors hold their force.
  void move_to(double z_m) {
    received_J_ += acts_N_ * (z_m - z_m_);
    most_J_ = std::max(most_J_, received_J_);
    z_m_ = z_m;
  }
  double most_J() const { return most_J_; }

 private:
  device::Traits traits_;
  double step_m_;
  std::deque<double> on_the_way_N_;
  double acts_N_ = 0.0;
  double z_m_ = 0.02;
  double received_J_ = 0.0;
  double most_J_ = 0.0;
};

struct Graze {
  int delay = 0;
  double step_m = 1e-5;
  double acceleration_m_per_s2 = 20.0;
  /// Duration of the contact.
  double contact_s = 0.004;
  /// Time of the first contact within a tick.
  double phase_s = 0.0;
};

/// The most that a hand received at any time, at the stiffness limit: it comes down, slows down evenly and
/// leaves as it came.
double received_J(Law law, const Graze& graze) {
  GuidedDevice device(graze.delay, graze.step_m);
  const SafeContact safe = safe_contact(device.traits(), 1.0 / kT_s, 1.0, 1e6, 0.0);
  LawParameters p = frictionless();
  p.law = law;
  p.stiffness_N_per_m = safe.stiffness_N_per_m;
  p.damping_Ns_per_m = safe.damping_Ns_per_m;
  HapticScene scene;
  const models::Scene ground = flat_ground(static_cast<float>(kGround_m));
  scene.touchable = made(ground, p);
  TickOptions observed;
  observed.passivity = Passivity::observe;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(device, scene, observed, events);
  const double half_s = 0.5 * graze.contact_s;
  const double a = graze.acceleration_m_per_s2;
  constexpr double kBefore_s = 0.030;
  for (int n = 0; n < 60; ++n) {
    const double t_s = kT_s * n - kBefore_s + graze.phase_s - half_s;
    device.move_to(kGround_m + 0.5 * a * (t_s * t_s - half_s * half_s));
    tick.step(kT_s * n, kT_s);
    while (events.take()) {
    }
  }
  // A contact of two ticks may be less deep than a step of the sensor.
  if (graze.contact_s > 0.004) {
    EXPECT_GT(tick.counts().contact_ticks, 0U);
  }
  return device.most_J();
}

class GrazingEnergy : public testing::TestWithParam<Law> {};

TEST_P(GrazingEnergy, IsNotMadeByForcesOfTheWayIn) {
  for (const int delay : {0, 1, 2})
    for (const double acceleration : {5.0, 10.0, 20.0})
      for (const double contact_ticks : {2.0, 3.0, 5.0, 7.0, 10.0, 14.0, 20.0})
        for (const double step_m : {1e-6, 5e-6, 1e-5})
          for (const double phase : {0.0, 0.3, 0.7}) {
            const Graze graze{delay, step_m, acceleration, contact_ticks * kT_s, phase * kT_s};
            EXPECT_LE(received_J(GetParam(), graze), 1e-6)
                << "delay " << delay << ", " << acceleration << " m/s^2, " << contact_ticks << " ticks, step "
                << step_m << ", phase " << phase;
          }
}

INSTANTIATE_TEST_SUITE_P(Laws, GrazingEnergy, testing::Values(Law::proxy, Law::penalty),
                         [](const auto& law) { return std::string(name_of(law.param)); });

}  // namespace
}  // namespace palpable::haptics
