// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/rest.hpp"

#include "palpable/device/pointer/pointer.hpp"
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/haptics/servo/test_touch.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

TEST(RestDetector, CountsTicksInWhichNothingChanges) {
  RestDetector rest;
  TouchSample sample;
  sample.position.v = {0.01, 0.0, 0.002};
  for (int k = 0; k <= 100; ++k) rest.update(sample, kT_s);
  EXPECT_NEAR(rest.rested_s(), 0.1, 1e-9);
}

TEST(RestDetector, BeginsAnewWithEachChange) {
  const auto after = [](void (*change)(TouchSample&)) {
    RestDetector rest;
    TouchSample sample;
    for (int k = 0; k <= 100; ++k) rest.update(sample, kT_s);
    change(sample);
    rest.update(sample, kT_s);
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
    rest.update(sample, kT_s);
    longest_s = std::max(longest_s, rest.rested_s());
  }
  EXPECT_LT(longest_s, 0.02);
}

/// Counts the readings of another device. Before each one it may do something, such as moving the hand.
class CountedDevice final : public device::Device {
 public:
  struct Readings {
    std::atomic<std::uint64_t> count{0};
    std::function<void()> before = [] {};
  };
  CountedDevice(std::unique_ptr<device::Device> inner, std::shared_ptr<Readings> readings)
      : inner_(std::move(inner)), readings_(std::move(readings)) {}

  const device::Traits& traits() const noexcept override { return inner_->traits(); }
  device::Reading read() noexcept override {
    readings_->before();
    ++readings_->count;
    readings_->count.notify_all();
    return inner_->read();
  }
  void write(Vector<DeviceFrame> force_N) noexcept override { inner_->write(force_N); }
  void stop() noexcept override { inner_->stop(); }

 private:
  std::unique_ptr<device::Device> inner_;
  std::shared_ptr<Readings> readings_;
};

/// A loop that enters rest mode soon, on a device whose readings can be awaited.
class CountedLoop {
 public:
  CountedLoop(std::unique_ptr<device::Device> device, double rest_after_s, std::function<void()> before) {
    ServoOptions options;
    options.realtime_priority = 0;
    options.memory = Memory::leave;
    options.rest_after_s = rest_after_s;
    readings_->before = std::move(before);
    auto started = ServoLoop::start(std::make_unique<CountedDevice>(std::move(device), readings_),
                                    {std::make_shared<SpringSurface>(flat, 500.0, 0.0), {}, 1}, options);
    EXPECT_TRUE(started);
    loop_ = std::move(*started);
  }
  ServoLoop* operator->() const { return loop_.get(); }

  /// Checks the condition after each reading until it holds.
  template <class Condition>
  void wait_until(Condition holds) const {
    for (auto seen = readings_->count.load(); !holds(); seen = readings_->count.load())
      readings_->count.wait(seen);
  }

 private:
  std::shared_ptr<CountedDevice::Readings> readings_ = std::make_shared<CountedDevice::Readings>();
  std::unique_ptr<ServoLoop> loop_;
};

/// A pointer whose position is sent again before every reading, as the page does between some of them.
class HeldPointer {
 public:
  explicit HeldPointer(double z_m)
      : z_m_(z_m), loop(std::make_unique<device::PointerDevice>(feed_, ServoOptions{}.rate_hz), 0.05, [this] {
          feed_->put(Point<DeviceFrame>{{0.0, 0.0, z_m_.load()}});
        }) {}
  void move_to(double z_m) { z_m_ = z_m; }

 private:
  std::shared_ptr<device::PointerFeed> feed_ = std::make_shared<device::PointerFeed>();
  std::atomic<double> z_m_;

 public:
  /// Ends before the feed.
  CountedLoop loop;
};

TEST(RestingLoop, TicksRarelyWhileNothingMovesAndFeelsTheNextMotion) {
  HeldPointer hand(0.001);
  hand.loop.wait_until([&] { return hand.loop->statistics().rested_s > 0.2; });
  const auto resting = hand.loop->statistics();
  // A tick in rest mode covers 20 ms.
  EXPECT_LT(static_cast<double>(resting.rest_ticks), resting.rested_s / 0.019 + 1.0);
  double force_N = 0.0;
  hand.move_to(-0.002);
  hand.loop.wait_until([&] {
    if (const auto sample = hand.loop->take_latest()) force_N = sample->written_force_N.v.z;
    return force_N > 0.99;
  });
  EXPECT_NEAR(force_N, 1.0, 0.01);
}

TEST(RestingLoop, KeepsTheForceOfAHandThatPressesAndRests) {
  const HeldPointer hand(-0.002);
  hand.loop.wait_until([&] { return hand.loop->statistics().rested_s > 0.2; });
  const auto sample = hand.loop->take_latest();
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->written_force_N.v.z, 1.0, 0.01);
}

TEST(RestingLoop, RecordsEveryTick) {
  const HeldPointer hand(0.001);
  hand.loop.wait_until([&] { return hand.loop->statistics().rested_s > 0.1; });
  hand.loop->record(Recording::on);
  hand.loop.wait_until([&] { return hand.loop->take_recorded().has_value(); });
  const double rested_s = hand.loop->statistics().rested_s;
  const auto ticks = hand.loop->statistics().touch.ticks;
  hand.loop.wait_until([&] { return hand.loop->statistics().touch.ticks > ticks + 300; });
  EXPECT_EQ(hand.loop->statistics().rested_s, rested_s);
}

TEST(RestingLoop, ReadsADeviceInEveryTickUnlessItMayRest) {
  for (const bool pushes_back : {false, true}) {
    auto device = std::make_unique<ScriptedDevice>();
    device->mutable_traits().pushes_back = pushes_back;
    const CountedLoop loop(std::move(device), 0.01, [] {});
    loop.wait_until([&] { return loop->statistics().touch.ticks >= 100; });
    EXPECT_EQ(loop->statistics().rest_ticks, 0U);
  }
}

}  // namespace
}  // namespace palpable::haptics
