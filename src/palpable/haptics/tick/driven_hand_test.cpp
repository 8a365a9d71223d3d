// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Hands whose way is prescribed, whatever pushes them: one that swings faster than its force can follow, and
// one at rest whose reading flickers.
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <numbers>
#include <ostream>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

struct Sensor {
  double step_m = 1e-6;
  int delay = 0;
};

/// Counts what it receives by its true way.
class DrivenHand final : public device::Device {
 public:
  explicit DrivenHand(const Sensor& sensor) : on_the_way_N_(static_cast<std::size_t>(sensor.delay)) {
    traits_.position_resolution_m = sensor.step_m;
    traits_.delay_samples = sensor.delay;
    traits_.max_force_N = 10.0;
    traits_.mass_kg = 0.1;
    traits_.pushes_back = true;
  }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    device::Reading reading;
    const double step_m = traits_.position_resolution_m;
    reading.position.v.z = step_m * (std::round(z_m_ / step_m) + off_steps);
    return reading;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    on_the_way_N_.push_back(force_N.v.z);
    received_J += on_the_way_N_.front() * (next_z_m - z_m_);
    on_the_way_N_.pop_front();
    z_m_ = next_z_m;
  }
  void stop() noexcept override {}

  double next_z_m = 0.01;
  double off_steps = 0.0;
  double received_J = 0.0;

 private:
  device::Traits traits_;
  double z_m_ = 0.01;
  std::deque<double> on_the_way_N_;
};

/// A touch of a plane at 0, from 10 mm above it to `rest_m` within 0.3 s.
class DrivenTouch {
 public:
  DrivenTouch(const Sensor& sensor, double stiffness_N_per_m, Passivity passivity)
      : hand(sensor), tick_(hand, plane(stiffness_N_per_m), options(passivity), events_) {}

  const TouchSample& step(double z_m) {
    hand.next_z_m = z_m;
    const TouchSample& sample = tick_.step(t_s_ += kT_s, kT_s);
    while (events_.take()) {
    }
    return sample;
  }
  void approach(
      double rest_m, const std::function<void(int)>& before_tick = [](int) {}) {
    for (int n = 0; n < 500; ++n) {
      before_tick(n);
      step(0.01 + (rest_m - 0.01) * std::min(1.0, n / 300.0));
    }
  }
  /// For two seconds; returns what the hand received, J.
  double swing(double centre_m, double hz) {
    constexpr double kSwing_m = 300e-6;
    hand.received_J = 0.0;
    for (int n = 1; n <= 2000; ++n)
      step(centre_m - kSwing_m * std::sin(2.0 * std::numbers::pi * hz * kT_s * n));
    return hand.received_J;
  }
  const TickCounts& counts() const { return tick_.counts(); }

  DrivenHand hand;

 private:
  static TickOptions options(Passivity passivity) {
    TickOptions made;
    made.passivity = passivity;
    return made;
  }
  const HapticScene& plane(double stiffness_N_per_m) {
    LawParameters law;
    law.stiffness_N_per_m = stiffness_N_per_m;
    law.damping_Ns_per_m = 1.0;
    scene_.touchable = made(scene_of(Raster<float>(64, 64), 0.15 / 64), law);
    return scene_;
  }

  HapticScene scene_;
  Ring<TouchEvent> events_{256};
  TickPipeline tick_;
  double t_s_ = 0.0;
};

TEST(DrivenHand, IsSaidToReceiveWhatItReceives) {
  for (const double step_m : {1e-6, 10e-6, 50e-6}) {
    DrivenTouch touch({step_m, 2}, 240.0, Passivity::observe);
    touch.approach(-0.001);
    const double received_J = touch.swing(-0.001, 90.0);
    EXPECT_GT(received_J, 5e-3);
    EXPECT_NEAR(touch.counts().made_max_J, received_J, 0.04 * received_J) << step_m << " m";
  }
}

struct Flicker {
  double step_m;
  double steps;
  int begins_tick;
  double kept;
};
void PrintTo(const Flicker& flicker, std::ostream* out) {
  *out << flicker.steps << " steps of " << flicker.step_m << " m from tick " << flicker.begins_tick;
}

class FlickeringReading : public testing::TestWithParam<Flicker> {};

TEST_P(FlickeringReading, TakesNoForceOfAHandAtRest) {
  const Flicker& flicker = GetParam();
  for (const int delay : {0, 1, 2}) {
    DrivenTouch touch({flicker.step_m, delay}, 500.0, Passivity::control);
    const auto flickers = [&](int n) {
      touch.hand.off_steps = n >= flicker.begins_tick && n % 2 == 1 ? flicker.steps : 0.0;
    };
    touch.approach(-0.003, flickers);
    double written_N = 0.0;
    double law_N = 0.0;
    for (int n = 500; n < 2500; ++n) {
      flickers(n);
      const TouchSample& sample = touch.step(-0.003);
      written_N += norm(sample.written_force_N);
      law_N += norm(sample.raw_force_N);
    }
    EXPECT_GE(written_N, flicker.kept * law_N) << "delay " << delay;
  }
}

// Before, flicker by two steps from the beginning on kept 90, 1 and 5 % of the force in the end.
INSTANTIATE_TEST_SUITE_P(Steps, FlickeringReading,
                         testing::Values(Flicker{1e-6, 2.0, 0, 0.99}, Flicker{10e-6, 2.0, 0, 0.99},
                                         Flicker{50e-6, 2.0, 0, 0.94}, Flicker{1e-6, 2.0, 1000, 0.99},
                                         Flicker{10e-6, 2.0, 1000, 0.99}, Flicker{50e-6, 2.0, 1000, 0.94},
                                         Flicker{10e-6, 3.0, 0, 0.93}, Flicker{10e-6, 4.0, 0, 0.93}));

}  // namespace
}  // namespace palpable::haptics
