// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/rest.hpp"

#include "palpable/device/pointer/pointer.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/haptics/servo/test_touch.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kTick_s = 0.001;

TEST(RestDetector, CountsTicksInWhichNothingChanges) {
  RestDetector rest;
  TouchSample sample;
  sample.position.v = {0.01, 0.0, 0.002};
  for (int k = 0; k <= 100; ++k) rest.update(sample, kTick_s);
  EXPECT_NEAR(rest.rested_s(), 0.1, 1e-9);
}

TEST(RestDetector, BeginsAnewWithEachChange) {
  const auto after = [](void (*change)(TouchSample&)) {
    RestDetector rest;
    TouchSample sample;
    for (int k = 0; k <= 100; ++k) rest.update(sample, kTick_s);
    change(sample);
    rest.update(sample, kTick_s);
    return rest.rested_s();
  };
  EXPECT_EQ(after([](TouchSample& s) { s.position.v.x += 2e-7; }), 0.0);
  EXPECT_EQ(after([](TouchSample& s) { s.written_force_N.v.z += 2e-4; }), 0.0);
  EXPECT_EQ(after([](TouchSample& s) { s.flags |= flag::kPaused; }), 0.0);
  EXPECT_EQ(after([](TouchSample& s) { s.status = device::Status::stale; }), 0.0);
  EXPECT_EQ(after([](TouchSample& s) { s.scene_id = 2; }), 0.0);
  EXPECT_GT(after([](TouchSample& s) { s.tick += 1; }), 0.1);
}

TEST(RestDetector, NoticesASlowDrift) {
  RestDetector rest;
  TouchSample sample;
  double longest_s = 0.0;
  // 10 nm per tick: each step is below the limit, the sum is not.
  for (int k = 0; k < 1000; ++k) {
    sample.position.v.x = 1e-8 * k;
    rest.update(sample, kTick_s);
    longest_s = std::max(longest_s, rest.rested_s());
  }
  EXPECT_LT(longest_s, 0.02);
}

/// A loop whose hand is moved through `feed`, and which enters rest mode soon.
std::unique_ptr<ServoLoop> pointer_loop(const std::shared_ptr<device::PointerFeed>& feed) {
  ServoOptions options;
  options.realtime_priority = 0;
  options.memory = Memory::leave;
  options.rest_after_s = 0.05;
  auto loop = ServoLoop::start(std::make_unique<device::PointerDevice>(feed, options.rate_hz),
                               {std::make_shared<SpringSurface>(flat, 500.0, 0.0), {}, 1}, options);
  EXPECT_TRUE(loop);
  return std::move(*loop);
}

void put(device::PointerFeed& feed, double z_m) { feed.put(Point<DeviceFrame>{{0.0, 0.0, z_m}}); }

/// Sends the position repeatedly, as the page does, until the condition holds.
template <class Condition>
void hold_until(device::PointerFeed& feed, double z_m, Condition holds) {
  while (!holds()) {
    put(feed, z_m);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

TEST(RestingLoop, TicksRarelyWhileNothingMovesAndFeelsTheNextMotion) {
  const auto feed = std::make_shared<device::PointerFeed>();
  const auto loop = pointer_loop(feed);
  hold_until(*feed, 0.001, [&] { return loop->statistics().rested_s > 0.2; });
  const auto resting = loop->statistics();
  // A tick in rest mode covers 20 ms.
  EXPECT_LT(static_cast<double>(resting.rest_ticks), resting.rested_s / 0.019 + 1.0);
  double force_N = 0.0;
  hold_until(*feed, -0.002, [&] {
    if (const auto sample = loop->take_latest()) force_N = sample->written_force_N.v.z;
    return force_N > 0.99;
  });
  EXPECT_NEAR(force_N, 1.0, 0.01);
}

TEST(RestingLoop, KeepsTheForceOfAHandThatPressesAndRests) {
  const auto feed = std::make_shared<device::PointerFeed>();
  const auto loop = pointer_loop(feed);
  hold_until(*feed, -0.002, [&] { return loop->statistics().rested_s > 0.2; });
  const auto sample = loop->take_latest();
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->written_force_N.v.z, 1.0, 0.01);
}

TEST(RestingLoop, RecordsEveryTick) {
  const auto feed = std::make_shared<device::PointerFeed>();
  const auto loop = pointer_loop(feed);
  hold_until(*feed, 0.001, [&] { return loop->statistics().rested_s > 0.1; });
  loop->record(Recording::on);
  while (!loop->take_recorded()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const double rested_s = loop->statistics().rested_s;
  const auto ticks = loop->statistics().touch.ticks;
  hold_until(*feed, 0.001, [&] { return loop->statistics().touch.ticks > ticks + 300; });
  EXPECT_EQ(loop->statistics().rested_s, rested_s);
}

TEST(RestingLoop, ReadsADeviceInEveryTickUnlessItMayRest) {
  ServoOptions options;
  options.realtime_priority = 0;
  options.memory = Memory::leave;
  options.rest_after_s = 0.01;
  for (const bool pushes_back : {false, true}) {
    auto device = std::make_unique<ScriptedDevice>();
    device->mutable_traits().pushes_back = pushes_back;
    auto loop = ServoLoop::start(std::move(device),
                                 {std::make_shared<SpringSurface>(flat, 500.0, 0.0), {}, 1}, options);
    ASSERT_TRUE(loop);
    while ((*loop)->statistics().touch.ticks < 100) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_EQ((*loop)->statistics().rest_ticks, 0U);
  }
}

}  // namespace
}  // namespace palpable::haptics
