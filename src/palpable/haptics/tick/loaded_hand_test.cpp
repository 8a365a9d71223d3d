// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A hand that rests on a surface with a load and sinks while a stall leaves it without force. To lift it
// again takes the load times the way: the spring has that only from what the hand puts in.
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <memory>
#include <ostream>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kWall_N_per_m = 500.0;

struct Load {
  const char* name;
  double load_N = 1.4;
  int stall_ticks = 50;
  int stalls = 1;
  double friction = 0.0;
  int delay = 0;
  /// It slides at this speed from half a second after the stall on.
  double slides_m_per_s = 0.0;
  /// How much deeper it may rest five seconds after the last stall, m.
  double deeper_m = 0.0;
};
void PrintTo(const Load& load, std::ostream* out) { *out << load.name; }

class LoadedHand : public testing::TestWithParam<Load> {
 protected:
  LoadedHand() : hand_(options()), tick_(hand_, scene(), {}, events_) {}

  void step(double dt_s) {
    const double goal_m = -GetParam().load_N * (1.0 / kWall_N_per_m + 1.0 / kArm_N_per_m);
    hand_.set_goal({x_m_, 0.0, std::max(goal_m, 0.002 - 0.2 * t_s_)});
    tick_.step(t_s_ += dt_s, dt_s);
    while (events_.take()) {
    }
  }
  void rest(int ticks, double slides_m_per_s = 0.0) {
    while (ticks-- > 0) {
      x_m_ += slides_m_per_s * kT_s;
      step(kT_s);
    }
  }
  void stall(int ticks) {
    hand_.stall(ticks);
    tick_.note_cut_force();
    step(ticks * kT_s);
  }
  double depth_m() const { return -hand_.true_position_m().z; }

 private:
  /// A loose arm, so that the load hardly changes on the way.
  static constexpr double kArm_N_per_m = 20.0;
  static device::HandOptions options() {
    device::HandOptions hand;
    hand.device_friction_N = 0.0;
    hand.arm_mass_kg = 0.3;
    hand.arm_damping_Ns_per_m = 5.0;
    hand.arm_stiffness_N_per_m = kArm_N_per_m;
    hand.resolution_m = 1e-6;
    hand.delay_samples = GetParam().delay;
    hand.max_force_N = 10.0;
    hand.script.kind = device::HandScriptOptions::Kind::hold;
    return hand;
  }
  static const HapticScene& scene() {
    static HapticScene level;
    models::Scene ground;
    ground.model = std::make_shared<const models::Relief>(
        *models::Relief::from_samples(Raster<float>(64, 64), 0.15 / 64));
    LawParameters law;
    law.law = Law::proxy;
    law.stiffness_N_per_m = kWall_N_per_m;
    law.damping_Ns_per_m = 1.0;
    law.static_friction = GetParam().friction;
    level.touchable = *make_touchable(ground, law);
    return level;
  }

  Ring<TouchEvent> events_{1024};
  CountedHand hand_;
  TickPipeline tick_;
  double t_s_ = 0.0;
  double x_m_ = -0.05;

 protected:
  double received_most_J() const { return hand_.most_J(); }
  double said_J() const { return tick_.counts().made_max_J; }
};

TEST_P(LoadedHand, IsCarriedAgainByWhatItPutsIn) {
  const Load& load = GetParam();
  rest(3000);
  const double before_m = depth_m();
  for (int n = 0; n < load.stalls; ++n) {
    stall(load.stall_ticks);
    rest(500);
  }
  EXPECT_GT(depth_m(), before_m + 1e-5) << "without force it sinks";
  rest(4500, load.slides_m_per_s);
  EXPECT_LE(depth_m(), before_m + load.deeper_m);
  EXPECT_LE(received_most_J(), 1e-6) << "more than the hand gave in this contact";
  EXPECT_LE(said_J(), 1e-6);
}

// In brackets what it was while the force took 0.25 s to come back and dampers and friction kept what they
// took.
INSTANTIATE_TEST_SUITE_P(
    Stalls, LoadedHand,
    testing::Values(
        Load{.name = "of_15_ms", .stall_ticks = 15, .deeper_m = 0.5e-3 /* 4.8 */},
        Load{.name = "of_50_ms", .deeper_m = 3.9e-3 /* 7.9 */},
        Load{.name = "three_of_12_ms",
             .load_N = 0.5,
             .stall_ticks = 12,
             .stalls = 3,
             .deeper_m = 0.4e-3 /* 3.2 */},
        Load{.name = "with_a_delay", .stall_ticks = 15, .delay = 2, .deeper_m = 0.8e-3},
        Load{.name = "and_slides", .friction = 0.3, .slides_m_per_s = 0.02, .deeper_m = 0.03e-3 /* 7.7 */}),
    [](const auto& load) { return std::string(load.param.name); });

}  // namespace
}  // namespace palpable::haptics
