// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The effect of limits on growing forces on the energy of hard impacts.
#include "palpable/haptics/safety/rise_limit.hpp"

#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// A free mass that hits a wall. Its motion is integrated in steps of 10 us under the held force.
struct Impact {
  double out_m_per_s = 0.0;
  double withheld_J = 0.0;
};
Impact thrown(double mass_kg, double speed_m_per_s, double stiffness, double damping, double cap_N,
              Passivity passivity, Returns returns = Returns::limited) {
  ScriptedDevice device;
  device.mutable_traits().max_force_N = cap_N;
  const HapticScene scene{std::make_shared<SpringSurface>(flat, stiffness, damping), {}, 1};
  TickOptions options;
  options.passivity = passivity;
  options.returns = returns;
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

TEST(RiseLimit, ReturnsNoMoreEnergyThanTheHandDelivered) {
  // The maximum force of the device is much greater, so the limit of 300 N/s is active.
  for (const double speed : {0.6, 1.0, 1.5}) {
    const Impact impact = thrown(0.3, speed, 960.0, 1.0, 20.0, Passivity::observe);
    EXPECT_LE(impact.out_m_per_s, speed) << speed;
    EXPECT_GT(impact.withheld_J, speed > 0.9 ? 1e-3 : 0.0) << speed;
  }
}

TEST(RiseLimit, GeneratesNoEnergyInRandomImpacts) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const double mass_kg = 0.05 + 0.45 * unit(random);
    const double speed = 0.05 + 1.9 * unit(random);
    const double stiffness = 200.0 + 900.0 * unit(random);
    // More than the held spring needs.
    const double damping = 1.2 * stiffness * kT_s;
    const double cap_N = 2.0 + 18.0 * unit(random);
    const Impact impact = thrown(mass_kg, speed, stiffness, damping, cap_N, Passivity::observe);
    if (impact.out_m_per_s < 0.0) continue;  // Heavier than the device can stop.
    const double gained_J = 0.5 * mass_kg * (impact.out_m_per_s * impact.out_m_per_s - speed * speed);
    EXPECT_LE(gained_J, 1e-6) << mass_kg << " kg " << speed << " m/s " << stiffness << " N/m " << cap_N
                              << " N";
  }
}

/// A hand on a given path: in free air, at depth `deep_m` from `in_s` to `out_s`, then in free air again.
/// Each transition takes 20 ms.
struct Guided {
  double in_s = 0.0;
  double out_s = 0.4;
  double deep_m = 0.005;
  /// Time at which one tick comes 20 ms late; never if below 0.
  double stall_s = -1.0;
};
struct HandWork {
  /// Total energy that the hand received, and the reported energy.
  double received_J = 0.0;
  double said_J = 0.0;
  /// By the ramp.
  double brought_J = 0.0;
  double deepest_force_N = 0.0;
};
HandWork guided(const Guided& hand) {
  ScriptedDevice device;
  device.mutable_traits().max_force_N = 3.3;
  const HapticScene scene{std::make_shared<SpringSurface>(flat, 500.0, 0.5), {}, 1};
  TickOptions options;
  Ring<TouchEvent> events(64);
  TickPipeline tick(device, scene, options, events);
  const auto z_at = [&](double t_s) {
    const double in = std::clamp((t_s - hand.in_s) / 0.02, 0.0, 1.0);
    const double out = std::clamp((t_s - hand.out_s) / 0.02, 0.0, 1.0);
    return 0.002 - (0.002 + hand.deep_m) * (in - out);
  };
  HandWork work;
  double t_s = 0.0, z = z_at(0.0), held_N = 0.0;
  while (t_s < hand.out_s + 0.1) {
    const bool stalls = hand.stall_s >= 0.0 && t_s <= hand.stall_s && t_s + kT_s > hand.stall_s;
    const double dt_s = stalls ? 0.02 : kT_s;
    t_s += dt_s;
    const double next = z_at(t_s);
    work.received_J += held_N * (next - z);
    z = next;
    device.reading.position.v = {0.0, 0.0, z};
    tick.step(t_s, dt_s);
    while (events.take()) {
    }
    held_N = device.written.back().z;
    work.deepest_force_N = std::max(work.deepest_force_N, held_N);
  }
  work.said_J = tick.counts().made_max_J;
  work.brought_J = tick.counts().scene_change_J;
  return work;
}

TEST(Ramp, ReturnsNoMoreEnergyThanItBroughtAndTheHandDeliveredWhereverItBegan) {
  for (const double deep_m : {0.001, 0.003, 0.007})
    for (const double in_s : {-0.1, 0.0, 0.05, 0.15, 0.24})
      for (const double out_s : {0.1, 0.3, 0.5}) {
        const HandWork work = guided({in_s, out_s + std::max(in_s, 0.0), deep_m});
        EXPECT_LE(work.received_J, work.brought_J + 1e-6)
            << deep_m << " m deep from " << in_s << " s to " << out_s << " s later";
        EXPECT_GE(work.said_J, std::min(work.received_J - work.brought_J, 1e-6));
        // Only a hand that is in contact when its touch begins is brought anything.
        if (in_s > 0.0) {
          EXPECT_EQ(work.brought_J, 0.0);
        }
      }
  // After a stall in free air and in contact.
  for (const double stall_s : {0.35, 0.5})
    EXPECT_LE(guided({0.4, 0.8, 0.005, stall_s}).received_J, 1e-6) << "stall at " << stall_s << " s";
}

TEST(Ramp, GivesARestingHandTheWholeSpring) {
  EXPECT_NEAR(guided({-0.1, 0.5, 0.003}).deepest_force_N, 1.5, 0.05);
}

TEST(PassivityController, NeverLetsASpringReturnAHandFaster) {
  // Without damping, the held spring generates energy; this is visible without the controller and the return
  // limit.
  constexpr double kSpeed = 0.3;
  double without = 0.0;
  for (const double mass_kg : {0.05, 0.15, 0.5}) {
    const auto faster = [&](Passivity passivity, Returns returns) {
      return thrown(mass_kg, kSpeed, 960.0, 0.0, 20.0, passivity, returns).out_m_per_s / kSpeed;
    };
    without = std::max(without, faster(Passivity::observe, Returns::free));
    EXPECT_LE(faster(Passivity::control, Returns::free), 1.06) << mass_kg;
    EXPECT_LE(faster(Passivity::observe, Returns::limited), 1.06) << mass_kg;
    EXPECT_LE(faster(Passivity::control, Returns::limited), 1.06) << mass_kg;
  }
  EXPECT_GT(without, 1.1);
}

/// A hand in a spring of 500 N/m whose force the limit may hold back.
class HandInASpring {
 public:
  void move_to(double depth_m) {
    constexpr double kStiffness_N_per_m = 500.0, kMaxRise_N = 0.3;
    const double out_m = depth_m_ - depth_m;
    RiseLimit::Input in;
    in.stored_J = 0.5 * kStiffness_N_per_m * depth_m * depth_m;
    in.spring_N = {{0.0, 0.0, kStiffness_N_per_m * depth_m}};
    in.received_J = written_N_ * out_m;
    in.moved_out_m = out_m;
    limit_.account(in);
    const Vector<DeviceFrame> velocity{{0.0, 0.0, out_m / kT_s}};
    written_N_ = norm(limit_.limit(in.spring_N, {}, kMaxRise_N, velocity).force_N);
    depth_m_ = depth_m;
  }
  double written_N() const { return written_N_; }

 private:
  RiseLimit limit_;
  double depth_m_ = 0.0;
  double written_N_ = 0.0;
};

TEST(RiseLimit, AReleaseThatHasBegunComesBackAsTheHandMovesInAgain) {
  constexpr double kDeep_m = 0.011, kToAndFro_m = 0.0001;
  HandInASpring hand;
  for (int n = 1; n <= 8; ++n) hand.move_to(kDeep_m * n / 8.0);
  EXPECT_LT(hand.written_N(), 3.0) << "the limit holds it back";
  for (int n = 0; n < 50; ++n) hand.move_to(kDeep_m);
  EXPECT_NEAR(hand.written_N(), 5.5, 1e-9);
  // In all twenty times the way over which the release ends.
  for (int n = 0; n < 100; ++n) {
    hand.move_to(kDeep_m - kToAndFro_m);
    hand.move_to(kDeep_m);
  }
  for (int n = 0; n < 20; ++n) hand.move_to(kDeep_m);
  EXPECT_NEAR(hand.written_N(), 5.5, 1e-6);
}

}  // namespace
}  // namespace palpable::haptics
