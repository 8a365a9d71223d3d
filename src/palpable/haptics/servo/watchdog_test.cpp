// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/watchdog.hpp"

#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/haptics/servo/test_touch.hpp"

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// State shared by a blocked device and its test.
struct Hang {
  std::mutex mutex;
  std::condition_variable changed;
  bool wanted = false;
  bool hangs = false;
  bool was_cut = false;
  bool freed = false;
  Vec3 force_when_cut_N;
};

/// Blocks in read() on request, as a driver does when its cable is unplugged.
class HangingDevice final : public device::Device {
 public:
  explicit HangingDevice(std::shared_ptr<Hang> hang) : hang_(std::move(hang)) {}
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    std::unique_lock lock(hang_->mutex);
    if (hang_->wanted && force_N_.z > 0.5) {
      hang_->wanted = false;
      hang_->hangs = true;
      hang_->changed.notify_all();
      hang_->changed.wait(lock, [&] { return hang_->freed; });
      hang_->hangs = false;
    }
    device::Reading reading;
    reading.position.v = {0.0, 0.0, -0.002};
    return reading;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    const std::lock_guard lock(hang_->mutex);
    force_N_ = force_N.v;
  }
  void stop() noexcept override { write({}); }
  void cut_force() noexcept override {
    const std::lock_guard lock(hang_->mutex);
    const Vec3 before_N = std::exchange(force_N_, {});
    // On a busy machine the loop may also be late before it hangs; then it hangs later, with force again.
    if (!hang_->hangs) return;
    hang_->force_when_cut_N = before_N;
    hang_->was_cut = true;
    hang_->changed.notify_all();
  }

 private:
  std::shared_ptr<Hang> hang_;
  device::Traits traits_;
  Vec3 force_N_;
};

TEST(Watchdog, CutsTheForceOfALoopThatHangsInItsDriver) {
  const auto hang = std::make_shared<Hang>();
  ServoOptions options;
  options.realtime_priority = 0;
  options.memory = Memory::leave;
  auto loop = ServoLoop::start(std::make_unique<HangingDevice>(hang),
                               {std::make_shared<SpringSurface>(flat, 500.0, 0.0), {}, 1}, options);
  ASSERT_TRUE(loop);
  {
    std::unique_lock lock(hang->mutex);
    hang->wanted = true;
    // The thread of the loop is blocked all the time, so only another thread can have set the force to zero.
    hang->changed.wait(lock, [&] { return hang->was_cut; });
    EXPECT_TRUE(hang->hangs);
    EXPECT_GT(hang->force_when_cut_N.z, 0.5);
    hang->freed = true;
    hang->changed.notify_all();
  }
  // The touch continues from zero force, and this is reported.
  bool stalled = false;
  while (!stalled)
    if (const auto sample = (*loop)->take_latest()) {
      stalled = sample->has(flag::kStalled);
      if (sample->has(flag::kRamping) && sample->tick > 300) stalled = true;
    }
  (*loop)->stop();
  EXPECT_GE((*loop)->statistics().touch.stalls, 1U);
}

/// Its force is cut while it is read.
struct DeviceCutInARead final : device::Device {
  const device::Traits& traits() const noexcept override { return own; }
  device::Reading read() noexcept override {
    if (hangs) cut = true;
    return reading;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override { written_N = force_N.v; }
  void stop() noexcept override {}
  device::Traits own;
  device::Reading reading;
  std::atomic<bool> cut{false};
  bool hangs = false;
  Vec3 written_N;
};

TEST(Watchdog, LetsTheForceOfAReadingThatHungRiseFromZero) {
  DeviceCutInARead device;
  const HapticScene scene{std::make_shared<SpringSurface>(flat, 500.0, 0.0), {}, 1};
  Ring<TouchEvent> events(64);
  TickPipeline tick(device, scene, {}, events);
  tick.watch_cuts(device.cut);
  double t_s = 0.0;
  const auto step = [&] { tick.step(t_s += 0.001, 0.001); };
  device.reading.position.v.z = 0.001;
  for (int n = 0; n < 300; ++n) step();
  for (int n = 0; n < 20; ++n) {
    device.reading.position.v.z -= 0.00025;
    step();
  }
  ASSERT_GT(device.written_N.z, 1.5);
  device.hangs = true;
  step();
  device.hangs = false;
  EXPECT_LE(device.written_N.z, 300.0 * 0.0015) << "one and a half periods of the rise limit";
  EXPECT_EQ(tick.counts().stalls, 1U);
}

constexpr std::int64_t kMillisecond = 1'000'000;

TEST(OverdueWrite, CutsOnceAfterAPeriodAndThePatience) {
  OverdueWrite overdue(0.001, 0.003);
  EXPECT_FALSE(overdue.must_cut(0, 1000 * kMillisecond)) << "nothing was written yet";
  const std::int64_t wrote = 7 * kMillisecond;
  EXPECT_FALSE(overdue.must_cut(wrote, wrote + 4 * kMillisecond));
  EXPECT_TRUE(overdue.must_cut(wrote, wrote + 4 * kMillisecond + 1));
  EXPECT_FALSE(overdue.must_cut(wrote, wrote + 500 * kMillisecond)) << "once";
  EXPECT_FALSE(overdue.must_cut(wrote + 600 * kMillisecond, wrote + 601 * kMillisecond));
  EXPECT_TRUE(overdue.must_cut(wrote + 600 * kMillisecond, wrote + 605 * kMillisecond)) << "and again";
}

TEST(OverdueWrite, CutsWithinFiveMillisecondsOfTheWriteThatWasDueAtEveryInstantOfAHang) {
  // The thread of the watchdog checks every kPoll_s, at any phase of the loop.
  constexpr auto kPoll = static_cast<std::int64_t>(1e9 * Watchdog::kPoll_s);
  for (const std::int64_t period : {kMillisecond / 4, kMillisecond, 10 * kMillisecond})
    for (std::int64_t phase = 0; phase < 1000; ++phase) {
      OverdueWrite overdue(1e-9 * static_cast<double>(period), Watchdog::kPatience_s);
      std::int64_t now = 1'000'000'000 + phase * kPoll / 1000;
      const std::int64_t hangs_from = now + 50 * period;
      std::int64_t wrote = 1;
      std::int64_t cut = 0;
      for (; cut == 0; now += kPoll) {
        while (wrote + period <= now && wrote + period <= hangs_from)
          wrote = wrote == 1 ? now : wrote + period;
        if (overdue.must_cut(wrote, now) && wrote != 1) cut = now;
      }
      ASSERT_LE(cut - (wrote + period), 5 * kMillisecond) << "phase " << phase;
      ASSERT_GT(cut, hangs_from) << "a loop that writes is never cut";
    }
}

TEST(Watchdog, MeasuresHowSoonItCutsTheForceOfALoopThatHangs) {
  const WatchdogLatency latency = measure_watchdog(1000.0, 5, 0);
  EXPECT_EQ(latency.hangs, 5);
  EXPECT_GE(latency.p50_ms, 1.0 + 1e3 * Watchdog::kPatience_s);
  EXPECT_LE(latency.p50_ms, latency.max_ms);
}

}  // namespace
}  // namespace palpable::haptics
