// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/tick.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/haptics/tick/test_loop.hpp"

#include <limits>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class NotFinite final : public Touchable {
 public:
  LawOutput evaluate(const Hand& hand, TouchState&) const noexcept override {
    LawOutput output;
    output.force_N.v.z = hand.position.v.z < 0.0 ? kNaN : 1.0;
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 9; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}
};

/// Its force counts the evaluations of its touch.
class Counting final : public Touchable {
 public:
  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override {
    seen = hand;
    ++evaluations;
    LawOutput output;
    output.force_N.v.z = 0.001 * ++state_as<int>(state);
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 10; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}
  mutable Hand seen;
  mutable int evaluations = 0;
};

TEST(Tick, ARehearsalEvaluatesTheExpectedHandAndChangesNothing) {
  const auto law = std::make_shared<Counting>();
  Loop rehearsed(law), other(std::make_shared<Counting>());
  for (int i = 0; i < 600; ++i) {
    for (Loop* loop : {&rehearsed, &other}) {
      loop->device.reading.position.v = {1e-4 * i, 0.0, 0.0};
      loop->run(1);
      EXPECT_DOUBLE_EQ(loop->sample->raw_force_N.v.z, 0.001 * (i + 1));
    }
    EXPECT_EQ(rehearsed.written(), other.written());
    const AllocationScope allocations;
    rehearsed.tick->rehearse(kT_s);
    EXPECT_EQ(allocations.count(), 0U);
  }
  EXPECT_EQ(law->evaluations, 1200);
  EXPECT_NEAR(law->seen.position.v.x, 1e-4 * 600, 1e-6);
  EXPECT_EQ(rehearsed.tick->counts().ticks, 600U);
}

TEST(Tick, RampsTheForceUpAtTheStart) {
  Loop loop(plane());
  loop.device.reading.position.v = {0.0, 0.0, -0.002};
  loop.run(1);
  EXPECT_NEAR(loop.written().z, 1.0 * kT_s / 0.25, 1e-9);
  loop.run(300);
  EXPECT_NEAR(loop.written().z, 1.0, 1e-12);
}

TEST(Tick, CapsTheForceAtTheDevicesGreatestAndCountsIt) {
  Loop loop(plane());
  loop.device.reading.position.v = {0.0, 0.0, -0.02};
  const auto& sample = loop.run(1100);
  EXPECT_NEAR(loop.written().z, 3.0, 1e-12);
  EXPECT_TRUE(sample.has(flag::kForceCapped));
  EXPECT_NEAR(sample.raw_force_N.v.z, 10.0, 1e-9);
  EXPECT_EQ(loop.tick->counts().force_capped_ticks, 1100U);
}

TEST(Tick, LimitsTheForcesRiseButNotItsRelease) {
  TickOptions options;
  options.passivity = Passivity::observe;
  Loop loop(plane(), options);
  loop.run(300);
  loop.device.reading.position.v = {0.0, 0.0, -0.002};
  const auto& sample = loop.run(1);
  EXPECT_TRUE(sample.has(flag::kRiseLimited));
  EXPECT_NEAR(loop.written().z, 0.3, 1e-9);
  loop.run(20);
  EXPECT_NEAR(loop.written().z, 1.0, 1e-9);
  loop.device.reading.position.v = {0.0, 0.0, 0.0004};
  loop.run(1);
  EXPECT_EQ(loop.written(), Vec3{});
}

TEST(Tick, RefusesAReadingThatIsNotFiniteAndRampsDown) {
  Loop loop(plane());
  loop.device.reading.position.v = {0.0, 0.0, -0.002};
  loop.run(400);
  loop.device.reading.position.v = {0.0, kNaN, -0.002};
  EXPECT_TRUE(loop.run(2).has(flag::kImplausible));
  EXPECT_NEAR(loop.written().z, 1.0, 1e-9) << "a glitch is not felt";
  loop.run(10);
  EXPECT_NEAR(loop.written().z, 0.5, 1e-9);
  loop.run(15);
  EXPECT_EQ(loop.written(), Vec3{});
  EXPECT_EQ(loop.count(TouchEvent::Kind::fault), 1);
  loop.device.reading.position.v = {0.0, 0.0, -0.002};
  loop.run(1);
  EXPECT_LT(loop.written().z, 0.01);
  loop.run(400);
  EXPECT_NEAR(loop.written().z, 1.0, 1e-9);
  EXPECT_EQ(loop.count(TouchEvent::Kind::recovered), 1);
}

TEST(Tick, RefusesAJumpThatNoHandMakes) {
  Loop loop(plane());
  loop.run(300);
  loop.device.reading.position.v = {0.04, 0.0, -0.02};
  const auto& sample = loop.run(1);
  EXPECT_TRUE(sample.has(flag::kImplausible));
  EXPECT_EQ(loop.written(), Vec3{});
  // If the new position lasts, it is a new touch, whose force rises from zero.
  EXPECT_TRUE(loop.run(1).has(flag::kImplausible));
  const auto& there = loop.run(1);
  EXPECT_FALSE(there.has(flag::kImplausible));
  EXPECT_TRUE(there.has(flag::kNewTouch));
  EXPECT_LT(norm(loop.written()), 0.1);
}

TEST(Tick, DoesNotFeelAGlitchOfAReading) {
  Loop loop(plane());
  for (const double glitch_m : {0.003, -0.003, 0.02}) {
    loop.device.reading.position.v = {0.0, 0.0, -0.001};
    loop.run(500);
    const Vec3 before = loop.written();
    loop.device.reading.position.v.z += glitch_m;
    loop.run(1);
    EXPECT_EQ(loop.written(), before);
    loop.device.reading.position.v.z -= glitch_m;
    loop.run(1);
    EXPECT_NEAR(loop.written().z, before.z, 1e-9);
  }
}

TEST(Tick, StartsANewTouchAfterAPersistentJump) {
  Loop loop(plane());
  loop.device.reading.position.v = {0.0, 0.0, 0.004};
  loop.run(500);
  for (const double jump_m : {0.006, 0.02}) {
    loop.device.reading.position.v = {0.0, 0.0, 0.004};
    loop.run(10);
    loop.device.reading.position.v = {0.0, 0.0, 0.004 - jump_m};
    bool is_new = false;
    for (int tick = 0; tick < 3; ++tick) {
      is_new = is_new || loop.run(1).has(flag::kNewTouch);
      EXPECT_LT(norm(loop.written()), 0.02) << jump_m << " " << tick;
    }
    EXPECT_TRUE(is_new) << jump_m;
  }
}

TEST(Tick, StartsFromZeroForceAfterAStall) {
  Loop loop(plane(5000.0));
  loop.device.mutable_traits().max_force_N = 20.0;
  loop.tick = std::make_unique<TickPipeline>(loop.device, loop.program, TickOptions{}, loop.events);
  loop.device.reading.position.v = {0.0, 0.0, -0.001};
  loop.run(500);
  ASSERT_GT(loop.written().z, 4.0);
  // 50 ms later the hand is deep inside; the watchdog has already written a force of zero.
  loop.device.reading.position.v = {0.0, 0.0, -0.004};
  const auto& sample = loop.tick->step(0.55, 0.05);
  EXPECT_TRUE(sample.has(flag::kStalled));
  EXPECT_LE(loop.written().z, 0.3 * 1.5 + 1e-9);
}

TEST(Tick, RampsToZeroWhenTheDeviceFailsOrTheSourceIsStale) {
  for (const auto status : {device::Status::fault, device::Status::stale, device::Status::not_ready}) {
    Loop loop(plane());
    loop.device.reading.position.v = {0.0, 0.0, -0.002};
    loop.run(400);
    loop.device.reading.status = status;
    loop.run(1);
    EXPECT_NEAR(loop.written().z, 0.95, 1e-9);
    loop.run(25);
    EXPECT_EQ(loop.written(), Vec3{});
    const auto& counts = loop.tick->counts();
    EXPECT_EQ(counts.fault_ticks, 26U);
  }
}

TEST(Tick, AFaultTakesAwayAForceThatTheRiseLimitStillHolds) {
  for (const auto status : {device::Status::fault, device::Status::stale, device::Status::ok}) {
    Loop loop(plane());
    loop.device.reading.position.v = {0.0, 0.0, 0.003};
    loop.run(400);
    // In 4 ms, 5 mm deep: the law wants 2.5 N, the limit has let pass less than half of it.
    for (int n = 0; n < 4; ++n) {
      loop.device.reading.position.v.z -= 0.002;
      loop.run(1);
    }
    const double before_N = loop.written().z;
    EXPECT_GT(before_N, 0.5);
    EXPECT_LT(before_N, 1.3);
    loop.device.reading.status = status;
    if (status == device::Status::ok)
      loop.device.reading.position.v.z = std::numeric_limits<double>::quiet_NaN();
    double last_N = before_N;
    for (int n = 0; n < 40; ++n) {
      loop.run(1);
      EXPECT_LE(loop.written().z, last_N) << n;
      last_N = loop.written().z;
    }
    EXPECT_EQ(loop.written(), Vec3{});
  }
}

TEST(Tick, NeverWritesAForceThatIsNotFinite) {
  Loop loop(std::make_shared<NotFinite>());
  loop.run(400);
  EXPECT_NEAR(loop.written().z, 1.0, 1e-9);
  loop.device.reading.position.v = {0.0, 0.0, -0.001};
  const auto& sample = loop.run(30);
  EXPECT_TRUE(sample.has(flag::kNotFinite));
  for (const Vec3 force : loop.device.written) ASSERT_TRUE(is_finite(force));
  EXPECT_EQ(loop.written(), Vec3{});
  EXPECT_GE(loop.count(TouchEvent::Kind::not_finite), 1);
}

TEST(Tick, HoldsZeroWhilePausedAndComesBackSlowly) {
  Loop loop(plane());
  loop.device.reading.position.v = {0.0, 0.0, -0.002};
  loop.run(400);
  loop.tick->set_paused(true);
  EXPECT_TRUE(loop.run(30).has(flag::kPaused));
  EXPECT_EQ(loop.written(), Vec3{});
  loop.tick->set_paused(false);
  loop.run(1);
  EXPECT_NEAR(loop.written().z, 0.004, 1e-9);
}

TEST(Tick, RotatesForcesIntoTheDeviceFrameAndKeepsTheirMagnitude) {
  Loop loop(plane());
  // The z axis of the scene is the y axis of the device, at twice the size.
  loop.program.scene_from_device.rotation = {1, 0, 0, 0, 0, -1, 0, 1, 0};
  loop.program.scene_from_device.scale = 2.0;
  loop.tick = std::make_unique<TickPipeline>(loop.device, loop.program, TickOptions{}, loop.events);
  loop.device.reading.position.v = {0.0, -0.001, 0.0};
  const auto& sample = loop.run(400);
  EXPECT_NEAR(sample.position.v.z, -0.002, 1e-12);
  EXPECT_NEAR(loop.written().y, 1.0, 1e-9);
  EXPECT_NEAR(loop.written().z, 0.0, 1e-12);
  EXPECT_NEAR(sample.written_force_N.v.z, 1.0, 1e-9);
}

TEST(Tick, PushesAPlanarDeviceInItsPlaneOnly) {
  Loop loop(std::make_shared<SpringSurface>(groove, 500.0, 0.0));
  loop.device.mutable_traits().degrees_of_freedom = 2;
  loop.tick = std::make_unique<TickPipeline>(loop.device, loop.program, TickOptions{}, loop.events);
  loop.device.reading.position.v = {0.002, 0.0, 0.0};
  loop.run(400);
  EXPECT_LT(loop.written().x, -0.4);
  EXPECT_EQ(loop.written().z, 0.0);
}

TEST(Tick, ReportsContactLabelsAndButtonsOnce) {
  Loop loop(plane());
  loop.device.reading.position.v = {-0.01, 0.0, -0.001};
  loop.run(5);
  loop.device.reading.position.v = {0.01, 0.0, -0.001};
  loop.device.reading.buttons = 4;
  loop.run(20);
  loop.device.reading.position.v = {0.01, 0.0, 0.001};
  loop.device.reading.buttons = 0;
  loop.run(20);
  int made = 0;
  int lost = 0;
  int labels = 0;
  int buttons = 0;
  while (const auto event = loop.events.take()) {
    made += event->kind == TouchEvent::Kind::contact_made ? 1 : 0;
    lost += event->kind == TouchEvent::Kind::contact_lost ? 1 : 0;
    labels += event->kind == TouchEvent::Kind::label_entered ? 1 : 0;
    if (event->kind == TouchEvent::Kind::button_down || event->kind == TouchEvent::Kind::button_up) {
      ++buttons;
      EXPECT_EQ(event->value, 2U);
    }
  }
  EXPECT_EQ(made, 1);
  EXPECT_EQ(lost, 1);
  EXPECT_EQ(labels, 2);
  EXPECT_EQ(buttons, 2);
}

TEST(Tick, NeverAllocates) {
  ASSERT_TRUE(allocations_are_counted());
  Loop loop(plane());
  HapticScene other;
  other.touchable = plane(700.0, 2);
  const AllocationScope scope;
  for (int i = 0; i < 2000; ++i) {
    loop.device.reading.position.v = {0.0, 0.0, 0.003 * std::sin(0.05 * i)};
    if (i % 500 == 400) loop.device.reading.position.v.z = kNaN;
    if (i == 1000) loop.tick->change(other);
    loop.run(1);
  }
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::haptics
