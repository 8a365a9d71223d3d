// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What limits on growing forces do to the energy of hard impacts.
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/servo/tick.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kT_s = 0.001;

/// A free mass thrown at a wall, moved in steps of 10 us under the force that is held.
struct Impact {
  double out_m_per_s = 0.0;
  double withheld_J = 0.0;
};
Impact thrown(double mass_kg, double speed_m_per_s, double stiffness, double damping, double cap_N,
              Passivity passivity) {
  ScriptedDevice device;
  device.mutable_traits().max_force_N = cap_N;
  const HapticScene scene{std::make_shared<SpringSurface>(flat, stiffness, damping), {}, 1};
  TickOptions options;
  options.passivity = passivity;
  Ring<TouchEvent> events(64);
  TickPipeline tick(device, scene, options, events);
  double z = 0.005;
  double v = 0.0;
  for (int n = 0; n < 5000; ++n) {
    if (n == 300) v = -speed_m_per_s;
    device.reading.position.v = {0.0, 0.0, z};
    tick.step(kT_s * n, kT_s);
    while (events.take()) {
    }
    const double force_N = device.written.back().z;
    for (int k = 0; k < 100; ++k) {
      v += force_N / mass_kg * kT_s / 100;
      z += v * kT_s / 100;
    }
    if (n > 300 && (z > 0.005 || z < -0.2)) break;
  }
  return {v, tick.counts().withheld_max_J};
}

TEST(RiseLimit, GivesBackNoMoreThanTheHandGave) {
  // The device's cap is far above, so that the limit of 300 N/s is what acts.
  for (const double speed : {0.6, 1.0, 1.5}) {
    const Impact impact = thrown(0.3, speed, 960.0, 1.0, 20.0, Passivity::observe);
    EXPECT_LE(impact.out_m_per_s, speed) << speed;
    EXPECT_GT(impact.withheld_J, speed > 0.9 ? 1e-3 : 0.0) << speed;
  }
}

TEST(RiseLimit, MakesNoEnergyInRandomImpacts) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const double mass_kg = 0.05 + 0.45 * unit(random);
    const double speed = 0.05 + 1.9 * unit(random);
    const double stiffness = 200.0 + 900.0 * unit(random);
    // Above what the held spring needs.
    const double damping = 1.2 * stiffness * kT_s;
    const double cap_N = 2.0 + 18.0 * unit(random);
    const Impact impact = thrown(mass_kg, speed, stiffness, damping, cap_N, Passivity::observe);
    if (impact.out_m_per_s < 0.0) continue;  // Heavier than the device can stop.
    const double gained_J = 0.5 * mass_kg * (impact.out_m_per_s * impact.out_m_per_s - speed * speed);
    EXPECT_LE(gained_J, 1e-6) << mass_kg << " kg " << speed << " m/s " << stiffness << " N/m " << cap_N
                              << " N";
  }
}

TEST(PassivityController, LetsNoSpringThrowAHandBackFaster) {
  // Undamped, the held spring makes energy; without controller it shows.
  double without = 0.0;
  for (const double mass_kg : {0.05, 0.15, 0.5}) {
    const double speed = 0.3;
    without =
        std::max(without, thrown(mass_kg, speed, 960.0, 0.0, 20.0, Passivity::observe).out_m_per_s / speed);
    EXPECT_LE(thrown(mass_kg, speed, 960.0, 0.0, 20.0, Passivity::control).out_m_per_s / speed, 1.06)
        << mass_kg;
  }
  EXPECT_GT(without, 1.1);
}

}  // namespace
}  // namespace palpable::haptics
