// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Changes of scene in a touch.
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/test_loop.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// A weight on a slope, 10 mJ high.
class HighGround final : public Touchable {
 public:
  LawOutput evaluate(const Hand& hand, TouchState&) const noexcept override {
    LawOutput output;
    output.contact = true;
    output.stored_J = 0.01 - 0.1 * hand.position.v.x;
    output.spring_N.v.x = output.force_N.v.x = 0.1;
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 77; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  EnergyModel energy_model() const noexcept override { return EnergyModel::weight; }
  void touch_pages() const noexcept override {}
};

TEST(TickChange, DoesNotTakeThePotentialOfAnotherKindOfLawForMadeEnergy) {
  Loop loop(plane());
  loop.device.reading.position.v.z = 5e-4;
  loop.run(10);
  const HapticScene high{std::make_shared<HighGround>(), {}, 2};
  loop.tick->change(high);
  for (int n = 0; n < 800; ++n) {
    loop.device.reading.position.v.x += 1e-5;
    loop.run(1);
  }
  EXPECT_GT(loop.written().x, 0.0);
  EXPECT_LE(loop.tick->counts().made_max_without_controller_J, 1e-12);
}

TEST(TickChange, FadesFromOneSceneToTheNextWithoutAStep) {
  Loop loop(plane(500.0));
  loop.device.reading.position.v = {0.0, 0.0, -0.002};
  loop.run(400);
  HapticScene stiffer;
  stiffer.touchable = plane(1000.0, 2);
  stiffer.id = 7;
  loop.tick->change(stiffer);
  double before = loop.written().z;
  double greatest_step = 0.0;
  for (int i = 0; i < 160; ++i) {
    loop.run(1);
    greatest_step = std::max(greatest_step, std::abs(loop.written().z - before));
    before = loop.written().z;
  }
  EXPECT_NEAR(before, 2.0, 1e-9);
  EXPECT_LE(greatest_step, 1.0 * kT_s / 0.15 + 1e-9);
  EXPECT_EQ(loop.tick->take_retired(), &loop.program);
  EXPECT_EQ(loop.tick->take_retired(), nullptr);
  EXPECT_EQ(loop.count(TouchEvent::Kind::scene_changed), 1);
  EXPECT_EQ(loop.sample->scene_id, 7U);
}

TEST(TickChange, DoesNotCountTheWorkOfAChangeOfSceneForTheLaw) {
  Loop loop(plane(500.0));
  // The hand gives what the spring holds: a touch that began inside would get nothing back.
  for (int i = 0; i <= 400; ++i) {
    loop.device.reading.position.v = {0.0, 0.0, -5e-6 * i};
    loop.run(1);
  }
  HapticScene other;
  other.touchable = plane(1500.0, 2);
  loop.tick->change(other);
  for (int i = 0; i < 300; ++i) {
    loop.device.reading.position.v.z += 5e-6;
    loop.run(1);
  }
  const auto& counts = loop.tick->counts();
  EXPECT_GT(counts.scene_change_J, 1e-4);
  // The energy that a held spring of 1500 N/m generates on the way out, ½K·dx² per tick, and no more.
  EXPECT_LT(counts.made_max_without_controller_J, 300 * 0.5 * 1500.0 * 25e-12 + 1e-12);
}

TEST(TickChange, ContinuesAStateWithinAFamilyAndBeginsAnewOutside) {
  Loop loop(plane(500.0, 3));
  loop.run(100);
  HapticScene same;
  same.touchable = plane(600.0, 3);
  loop.tick->change(same);
  HapticScene other;
  other.touchable = plane(600.0, 4);
  loop.run(200);
  EXPECT_EQ(loop.tick->take_retired(), &loop.program);
  loop.tick->change(other);
  loop.run(200);
  EXPECT_EQ(loop.tick->take_retired(), &same);
}

TEST(TickChange, EndsAFadeInItsTimeThoughTheDeviceIsAway) {
  Loop loop(plane());
  loop.run(400);
  HapticScene other;
  other.touchable = plane(700.0, 2);
  loop.tick->change(other);
  loop.device.reading.status = device::Status::not_ready;
  loop.run(140);
  EXPECT_TRUE(loop.tick->fading());
  loop.run(15);
  EXPECT_FALSE(loop.tick->fading());
  EXPECT_EQ(loop.tick->take_retired(), &loop.program);
  loop.device.reading.status = device::Status::ok;
  loop.run(400);
  EXPECT_NEAR(loop.written().z, 700.0 * -loop.device.reading.position.v.z, 1e-9);
}

TEST(TickChange, EnergyOfAStiffnessThatGrowsUnderAPressingHandIsTheChangesNotTheLaws) {
  TickOptions options;
  options.passivity = Passivity::observe;
  Loop loop(plane(100.0), options);
  loop.device.reading.position.v = {0.0, 0.0, 0.0005};
  loop.run(10);
  for (int k = 1; k <= 20; ++k) {
    loop.device.reading.position.v.z = 0.0005 - 1.25e-4 * k;
    loop.run(1);
  }
  // 2 mm deep: 0.2 mJ at 100 N/m, 1.4 mJ at 700 N/m.
  HapticScene stiffer{plane(700.0), {}, 2};
  loop.tick->change(stiffer);
  loop.run(300);
  EXPECT_NEAR(loop.tick->counts().scene_change_J, 1.2e-3, 2e-5);
  for (int k = 1; k <= 40; ++k) {
    loop.device.reading.position.v.z = -0.002 + 1e-4 * k;
    loop.run(1);
  }
  EXPECT_LE(loop.tick->counts().made_max_J, 1e-4) << "what a held spring of 700 N/m without a damper makes";
}

/// What a change to a plane 12 mm higher does to a hand in an arm of 150 N/m.
struct Lifted {
  double grows_N = 0.0;
  double falls_N = 0.0;
  double fastest_m_per_s = 0.0;
  double got_J = 0.0;
  double said_J = 0.0;
};

Lifted lifted(double goal_m, int delay, double stiffness_N_per_m) {
  constexpr int kChange = 1200;
  device::HandOptions options;
  options.arm_mass_kg = 0.2;
  options.arm_damping_Ns_per_m = 3.0;
  options.arm_stiffness_N_per_m = 150.0;
  options.max_force_N = 10.0;
  options.delay_samples = delay;
  options.script.kind = device::HandScriptOptions::Kind::hold;
  CountedHand hand(options);
  HapticScene low;
  low.touchable = std::make_shared<SpringSurface>(flat, stiffness_N_per_m, 0.6);
  const auto above = [](double, double) { return SpringSurface::Height{0.012, 0.0, 0.0}; };
  const HapticScene high{std::make_shared<SpringSurface>(above, stiffness_N_per_m, 0.6, 2), {}, 2};
  TickOptions tick_options;
  tick_options.fade_s = 0.03;
  Ring<TouchEvent> events(64);
  TickPipeline tick(hand, low, tick_options, events);
  hand.set_goal({0.0, 0.0, 0.01});
  Lifted result;
  Vec3 before_N;
  double least_J = 0.0;
  for (int n = 0; n < 2400; ++n) {
    if (n == 100) hand.set_goal({0.0, 0.0, goal_m});
    if (n == kChange) tick.change(high);
    const double before_m = hand.true_position_m().z;
    const Vec3 written_N = tick.step(kT_s * n, kT_s).written_force_N.v;
    if (n == kChange) least_J = hand.total_J();
    if (n >= kChange) {
      result.grows_N = std::max(result.grows_N, norm(written_N) - norm(before_N));
      result.falls_N = std::max(result.falls_N, norm(before_N) - norm(written_N));
      result.fastest_m_per_s = std::max(result.fastest_m_per_s, (hand.true_position_m().z - before_m) / kT_s);
      result.got_J = std::max(result.got_J, hand.total_J() - least_J);
    }
    before_N = written_N;
  }
  result.said_J = tick.counts().scene_change_J;
  return result;
}

TEST(TickChange, ASurfaceThatComesUpUnderAHandLiftsItAndDoesNotThrowIt) {
  // Pressing, and at rest in the air above the lower plane.
  for (const double goal_m : {-0.005, 0.004})
    for (const int delay : {0, 2}) {
      const Lifted hand = lifted(goal_m, delay, delay == 0 ? 400.0 : 150.0);
      EXPECT_LE(hand.grows_N, 0.15) << goal_m << " " << delay;
      EXPECT_LE(hand.falls_N, 0.15) << goal_m << " " << delay;
      EXPECT_LE(hand.fastest_m_per_s, 0.08) << goal_m << " " << delay;
      EXPECT_GT(hand.got_J, 1e-3) << "it is lifted";
      EXPECT_GE(hand.said_J, hand.got_J) << goal_m << " " << delay;
    }
}

}  // namespace
}  // namespace palpable::haptics
