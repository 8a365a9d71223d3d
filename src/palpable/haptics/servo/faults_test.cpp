// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Faults at 1000 random instants of a press, each kind by itself: whatever happens to readings, ticks and
// scenes, the force never grows faster than the rise limit, never pulls and never pushes to a side; a glitch
// is not felt, and after a lasting jump, a silence or a stall the force begins from zero.
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/servo/tick.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kT_s = 0.001;
constexpr int kInstants = 1000;

/// A hand that presses to and fro on level ground, 2 mm deep at most, on a device of 20 N.
class Press {
 public:
  Press() {
    device_.mutable_traits().max_force_N = 20.0;
    device_.mutable_traits().workspace_m = {0.1, 0.1, 0.1};
    for (const double radius_m : {0.0, 0.001})
      for (const double stiffness_N_per_m : {500.0, 1500.0})
        for (const float ground_m : {0.005F, 0.0052F}) {
          LawParameters p = frictionless(radius_m);
          p.stiffness_N_per_m = stiffness_N_per_m;
          p.damping_Ns_per_m = 2.0;
          scenes_.push_back(
              std::make_unique<HapticScene>(HapticScene{made(flat_ground(ground_m), p), {}, 0}));
        }
    tick_ = std::make_unique<TickPipeline>(device_, *scenes_.front(), options_, events_);
  }

  /// What the next ticks have of the fault.
  double shift_m = 0.0;
  bool is_silent = false;
  bool is_nan = false;
  double dt_s = kT_s;

  void change(std::size_t scene) {
    if (!tick_->fading()) tick_->change(*scenes_[scene % scenes_.size()]);
  }

  void step() {
    t_s_ += dt_s;
    device_.reading = {};
    device_.reading.position = {
        {0.003 * std::sin(2.0 * t_s_), 0.0, 0.005 + 0.002 * std::sin(9.0 * t_s_) + shift_m}};
    if (is_nan) device_.reading.position.v.z = std::numeric_limits<double>::quiet_NaN();
    if (is_silent) device_.reading.status = device::Status::stale;
    const Vector<DeviceFrame> before = written_;
    tick_->step(t_s_, dt_s);
    written_ = {device_.written.back()};
    device_.written.clear();
    const double rise_N = options_.max_force_rate_N_per_s * 1.5 * kT_s;
    const auto risen = cap_rise(written_, before, rise_N);
    ASSERT_LT(norm(risen.force_N - written_), 1e-9) << norm(before) << " N to " << norm(written_) << " N";
    ASSERT_GE(written_.v.z, 0.0);
    // A first contact's proxy is where the hand came in, a tick's way behind: less than can be felt.
    ASSERT_LT(std::hypot(written_.v.x, written_.v.y), 0.02);
    pressed_ += written_.v.z > 0.5 ? 1 : 0;
    while (events_.take()) {
    }
  }
  int pressed() const { return pressed_; }
  double force_N() const { return norm(written_); }
  const TickOptions& options() const { return options_; }

 private:
  TickOptions options_;
  ScriptedDevice device_;
  std::vector<std::unique_ptr<HapticScene>> scenes_;
  Ring<TouchEvent> events_{256};
  std::unique_ptr<TickPipeline> tick_;
  Vector<DeviceFrame> written_;
  double t_s_ = 0.0;
  int pressed_ = 0;
};

/// The force in the tick `n` of a fault, from 0, and before the fault.
using Check = std::function<void(const Press&, int n, double before_N)>;

/// `fault` sets what happens now and gives for how many ticks; `check` judges each of them; `over` ends it.
void attack(const std::function<int(Press&, std::mt19937&)>& fault, const Check& check,
            const std::function<void(Press&)>& over) {
  std::mt19937 random(21);
  std::uniform_int_distribution<int> wait(20, 900);
  Press press;
  for (int k = 0; k < kInstants; ++k) {
    for (int n = wait(random); n > 0; --n) ASSERT_NO_FATAL_FAILURE(press.step()) << "before fault " << k;
    const double before_N = press.force_N();
    const int ticks = fault(press, random);
    for (int n = 0; n < ticks; ++n) {
      ASSERT_NO_FATAL_FAILURE(press.step()) << "in fault " << k;
      ASSERT_NO_FATAL_FAILURE(check(press, n, before_N)) << "in fault " << k;
    }
    over(press);
  }
  EXPECT_GT(press.pressed(), 100 * kInstants / 4);
}

/// A force that begins from zero is this small in its first tick: a thousandth of the device's, and some.
constexpr double kBegins_N = 0.2;

double from(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
int sign(std::mt19937& random) { return (random() & 1U) != 0 ? 1 : -1; }

TEST(Faults, OfASensorThatGlitchesMakeNoStepAndNoPull) {
  attack(
      [](Press& press, std::mt19937& random) {
        press.shift_m += sign(random) * from(random, 0.003, 0.05);
        return std::uniform_int_distribution<int>(1, 2)(random);
      },
      [](const Press& press, int, double before_N) { ASSERT_EQ(press.force_N(), before_N); },
      [](Press& press) { press.shift_m = 0.0; });
}

TEST(Faults, OfASensorThatJumpsForGoodMakeNoStepAndNoPull) {
  attack(
      [](Press& press, std::mt19937& random) {
        press.shift_m = press.shift_m == 0.0 ? sign(random) * from(random, 0.003, 0.02) : 0.0;
        return 3;
      },
      [](const Press& press, int n, double before_N) {
        // Two readings may be a glitch; the third one agrees with them.
        if (n < 2) {
          ASSERT_EQ(press.force_N(), before_N);
        }
        if (n == 2) {
          ASSERT_LT(press.force_N(), kBegins_N);
        }
      },
      [](Press&) {});
}

TEST(Faults, OfADeviceThatFallsSilentOrGivesNoNumberMakeNoStepAndNoPull) {
  attack(
      [](Press& press, std::mt19937& random) {
        (sign(random) > 0 ? press.is_silent : press.is_nan) = true;
        return std::uniform_int_distribution<int>(1, 120)(random);
      },
      [](const Press& press, int n, double) {
        const int gone = 3 + static_cast<int>(press.options().ramp_down_s / kT_s);
        if (n >= gone) {
          ASSERT_EQ(press.force_N(), 0.0);
        }
      },
      [](Press& press) { press.is_silent = press.is_nan = false; });
}

TEST(Faults, OfALoopThatStallsMakeNoStepAndNoPull) {
  attack(
      [](Press& press, std::mt19937& random) {
        press.dt_s = from(random, 0.002, 0.2);
        return 1;
      },
      [](const Press& press, int, double) {
        if (press.dt_s > press.options().stall_s) {
          ASSERT_LT(press.force_N(), kBegins_N);
        }
      },
      [](Press& press) { press.dt_s = kT_s; });
}

TEST(Faults, OfChangesOfSceneRadiusAndStiffnessMakeNoStepAndNoPull) {
  attack(
      [](Press& press, std::mt19937& random) {
        press.change(random());
        return 1;
      },
      [](const Press&, int, double) {}, [](Press&) {});
}

}  // namespace
}  // namespace palpable::haptics
