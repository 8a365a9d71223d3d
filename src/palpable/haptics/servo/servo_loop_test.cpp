// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/servo_loop.hpp"

#include "palpable/device/pointer/pointer.hpp"
#include "palpable/haptics/servo/test_touch.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

ServoOptions quiet() {
  ServoOptions options;
  options.realtime_priority = 0;
  options.memory = Memory::leave;
  options.tick.fade_s = 0.002;
  return options;
}

/// State that outlives the loop that owned the device.
struct Log {
  std::atomic<int> writes{0};
  std::atomic<int> stops{0};
  std::atomic<bool> last_was_zero{true};
};

class LoggingDevice final : public device::Device {
 public:
  explicit LoggingDevice(Log& log) : log_(log) { traits_.max_force_N = 3.0; }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Traits& mutable_traits() { return traits_; }
  device::Reading read() noexcept override { return {{{0.0, 0.0, -0.002}}, device::Status::ok, 0}; }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    ++log_.writes;
    log_.last_was_zero = force_N.v == Vec3{};
  }
  void stop() noexcept override { ++log_.stops; }
  // The watchdog acts if the machine delays the loop.
  void cut_force() noexcept override {}

 private:
  Log& log_;
  device::Traits traits_;
};

/// Counts its living instances, so a test can see that old scenes are freed.
class CountedTouchable final : public Touchable {
 public:
  CountedTouchable(std::atomic<int>& alive, double force_N) : alive_(alive), force_N_(force_N) { ++alive_; }
  ~CountedTouchable() override { --alive_; }
  LawOutput evaluate(const Hand&, TouchState&) const noexcept override {
    LawOutput output;
    output.force_N.v.z = force_N_;
    output.contact = true;
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 5; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}

 private:
  std::atomic<int>& alive_;
  double force_N_;
};

HapticScene counted(std::atomic<int>& alive, double force_N, std::uint32_t id = 0) {
  HapticScene program;
  program.touchable = std::make_shared<CountedTouchable>(alive, force_N);
  program.id = id;
  return program;
}

void wait_for_ticks(const ServoLoop& loop, std::uint64_t ticks) {
  while (loop.statistics().touch.ticks < ticks) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

TEST(ServoLoop, RefusesARateThatItCannotServe) {
  Log log;
  std::atomic<int> alive{0};
  for (const double rate : {0.0, 99.0, 4001.0, std::numeric_limits<double>::quiet_NaN()}) {
    ServoOptions options = quiet();
    options.rate_hz = rate;
    const auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), options);
    ASSERT_FALSE(loop);
    EXPECT_EQ(loop.error().code, ErrorCode::usage);
  }
}

TEST(ServoLoop, RunsAtEveryRateWithTheOptionsThatItHas) {
  for (const double rate : {100.0, 1000.0, 4000.0}) {
    Log log;
    std::atomic<int> alive{0};
    ServoOptions options;
    options.rate_hz = rate;
    options.realtime_priority = 0;
    options.memory = Memory::leave;
    const auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), options);
    ASSERT_TRUE(loop) << rate;
    wait_for_ticks(**loop, 20);
  }
}

TEST(ServoLoop, RefusesADeviceWithoutAForceLimitAndOptionsOutOfRange) {
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  Log log;
  std::atomic<int> alive{0};
  for (const double force : {kNotANumber, std::numeric_limits<double>::infinity(), -1.0}) {
    auto device = std::make_unique<LoggingDevice>(log);
    device->mutable_traits().max_force_N = force;
    EXPECT_FALSE(ServoLoop::start(std::move(device), counted(alive, 1.0), quiet())) << force;
  }
  std::vector<ServoOptions> wrong(4, quiet());
  wrong[0].recording_capacity = 0;
  wrong[1].tick.max_speed_m_per_s = kNotANumber;
  wrong[2].tick.glitch_readings = -5;
  wrong[3].tick.max_transient_of_force = 50.0;
  for (std::size_t i = 0; i < wrong.size(); ++i)
    EXPECT_FALSE(ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), wrong[i])) << i;
  EXPECT_EQ(alive, 0);
}

TEST(ServoLoop, WritesZeroForceOnEveryExit) {
  Log log;
  std::atomic<int> alive{0};
  {
    auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), quiet());
    ASSERT_TRUE(loop);
    wait_for_ticks(**loop, 50);
    EXPECT_FALSE(log.last_was_zero);
  }
  EXPECT_TRUE(log.last_was_zero);
  EXPECT_EQ(log.stops, 1);
  EXPECT_EQ(alive, 0);
}

TEST(ServoLoop, AllocatesNothingInItsTicksAndCountsThem) {
  Log log;
  std::atomic<int> alive{0};
  auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), quiet());
  ASSERT_TRUE(loop);
  (*loop)->record(Recording::on);
  wait_for_ticks(**loop, 300);
  (*loop)->stop();
  const auto statistics = (*loop)->statistics();
  EXPECT_EQ(statistics.allocations_in_ticks, 0U);
  EXPECT_EQ(static_cast<std::uint64_t>(log.writes), statistics.touch.ticks + 1);
  // If the machine delayed the loop for long, the force restarts from zero.
  if (statistics.touch.stalls == 0) {
    EXPECT_NEAR(statistics.touch.max_force_N, 1.0, 1e-9);
  }
  EXPECT_GT(statistics.touch.first_force_t_s, 0.0);
  // Every period since the start was either served or counted as missed.
  EXPECT_GT(statistics.rate_hz, 0.0);
  EXPECT_LE(statistics.rate_hz, 1001.0);
}

TEST(ServoLoop, RecordsEveryTickInOrderAndCountsWhatItLoses) {
  Log log;
  std::atomic<int> alive{0};
  ServoOptions options = quiet();
  options.recording_capacity = 64;
  auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), options);
  ASSERT_TRUE(loop);
  (*loop)->record(Recording::on);
  int taken = 0;
  std::uint64_t before = 0;
  bool in_order = true;
  while (taken < 500) {
    const auto sample = (*loop)->take_recorded();
    if (!sample) {
      std::this_thread::yield();
      continue;
    }
    in_order = in_order && (taken == 0 || sample->tick > before);
    before = sample->tick;
    ++taken;
  }
  EXPECT_TRUE(in_order);
  // Nobody reads the ring any more: it becomes full, and the loop continues.
  wait_for_ticks(**loop, before + 200);
  EXPECT_GT((*loop)->recording_lost(), 0U);
}

TEST(ServoLoop, SwapsScenesLiveAndFreesTheOldOnesOnAnotherThread) {
  constexpr int kChanges = 100;
  Log log;
  std::atomic<int> alive{0};
  auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), quiet());
  ASSERT_TRUE(loop);
  int faded = 0;
  for (std::uint32_t id = 1; id <= kChanges; ++id) {
    (*loop)->change(counted(alive, 1.0 + 0.01 * id, id));
    // The test waits until the servo has taken each scene: it counts scenes that were taken, not scenes that
    // were sent.
    for (bool arrived = false; !arrived;) {
      while (const auto event = (*loop)->take_event())
        arrived = arrived || (event->kind == TouchEvent::Kind::scene_changed && event->value == id);
      std::this_thread::yield();
    }
    ++faded;
  }
  EXPECT_EQ(faded, kChanges);
  // The maintenance thread frees scenes periodically; the end of the loop frees the rest.
  while (alive > 2) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  (*loop)->stop();
  EXPECT_EQ((*loop)->statistics().allocations_in_ticks, 0U);
  loop->reset();
  EXPECT_EQ(alive, 0);
}

TEST(ServoLoop, KeepsOnlyTheNewestOfScenesThatComeTooFast) {
  Log log;
  std::atomic<int> alive{0};
  ServoOptions options = quiet();
  options.tick.fade_s = 0.02;
  auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), options);
  ASSERT_TRUE(loop);
  for (std::uint32_t id = 1; id <= 1000; ++id) (*loop)->change(counted(alive, 2.0, id));
  std::uint32_t last = 0;
  while (last != 1000) {
    while (const auto event = (*loop)->take_event())
      if (event->kind == TouchEvent::Kind::scene_changed) last = event->value;
    std::this_thread::yield();
  }
  loop->reset();
  EXPECT_EQ(alive, 0);
}

TEST(ServoLoop, ShowsTheLatestSampleToAnotherThread) {
  Log log;
  std::atomic<int> alive{0};
  auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), quiet());
  ASSERT_TRUE(loop);
  int evaluations = 0;
  std::uint64_t before = 0;
  bool forwards = true;
  while (evaluations < 200) {
    if (const auto sample = (*loop)->take_latest()) {
      forwards = forwards && (evaluations == 0 || sample->tick > before);
      before = sample->tick;
      ++evaluations;
    }
    std::this_thread::yield();
  }
  EXPECT_TRUE(forwards);
}

TEST(ServoLoop, PausesToZeroAndResumes) {
  Log log;
  std::atomic<int> alive{0};
  auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0), quiet());
  ASSERT_TRUE(loop);
  wait_for_ticks(**loop, 50);
  (*loop)->pause();
  while (!log.last_was_zero) std::this_thread::yield();
  (*loop)->resume();
  while (log.last_was_zero) std::this_thread::yield();
}

/// An additional probe, which a test moves and removes while the loop runs.
std::unique_ptr<device::Device> probe_of(const std::shared_ptr<device::PointerFeed>& feed) {
  return std::make_unique<device::PointerDevice>(feed, 1000.0);
}

/// The first sample of a probe that satisfies the condition. Sends the position of the probe repeatedly
/// meanwhile, as the page does.
std::optional<TouchSample> wait_for(ServoLoop& loop, std::size_t probe, device::PointerFeed& feed,
                                    const std::optional<Point<DeviceFrame>>& place,
                                    const std::function<bool(const TouchSample&)>& fits) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < end) {
    feed.put(place);
    const auto sample = loop.take_latest(probe);
    if (sample && fits(*sample)) return sample;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return std::nullopt;
}

TEST(ServoLoop, FurtherProbesTouchTheSameSceneIndependently) {
  Log log;
  HapticScene program;
  program.touchable = std::make_shared<SpringSurface>(flat, 500.0, 0.0);
  const std::vector feeds{std::make_shared<device::PointerFeed>(), std::make_shared<device::PointerFeed>()};
  std::vector<std::unique_ptr<device::Device>> further;
  for (const auto& feed : feeds) further.push_back(probe_of(feed));
  auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), program, quiet(), std::move(further));
  ASSERT_TRUE(loop);
  (*loop)->record(Recording::on);
  const auto pressed = [](double force_N) {
    return [force_N](const TouchSample& s) { return std::abs(s.written_force_N.v.z - force_N) < 1e-6; };
  };
  const auto first = wait_for(**loop, 1, *feeds[0], {{{0.01, 0.0, -0.001}}}, pressed(0.5));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->probe, 1);
  EXPECT_EQ(first->label, 1);
  const auto second = wait_for(**loop, 2, *feeds[1], {{{-0.01, 0.0, -0.003}}}, pressed(1.5));
  ASSERT_TRUE(second);
  EXPECT_EQ(second->probe, 2);
  EXPECT_EQ(second->label, 0);
  const auto gone = wait_for(**loop, 2, *feeds[1], {}, [](const TouchSample& s) { return !is_present(s); });
  ASSERT_TRUE(gone);
  EXPECT_EQ(gone->written_force_N.v.z, 0.0);
  EXPECT_FALSE((*loop)->take_latest(3));
  // On a busy machine, stalls begin the ramp of the hand's force anew.
  while ((*loop)->statistics().touch.max_force_N < 1.0 - 1e-9)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  (*loop)->stop();
  // The hand was served, and its device was written to, as if there were no other probe.
  const auto statistics = (*loop)->statistics();
  EXPECT_EQ(statistics.allocations_in_ticks, 0U);
  EXPECT_LE(statistics.touch.max_force_N, 1.0 + 1e-9);
  EXPECT_EQ(static_cast<std::uint64_t>(log.writes), statistics.touch.ticks + 1);
  std::array<std::uint64_t, 3> recorded{};
  while (const auto sample = (*loop)->take_recorded()) ++recorded.at(sample->probe);
  for (const std::size_t probe : {1, 2}) {
    EXPECT_GT(recorded.at(probe), 0U);
    EXPECT_GE(recorded[0], recorded.at(probe));
  }
}

// A surface that comes up under a probe takes its time, while the hand, in the air, has long changed.
TEST(ServoLoop, KeepsASceneUntilTheLastProbeHasLeftIt) {
  Log log;
  auto feed = std::make_shared<device::PointerFeed>();
  std::vector<std::unique_ptr<device::Device>> further;
  further.push_back(probe_of(feed));
  const auto scene_of = [](SpringSurface::Shape shape, std::uint32_t id) {
    HapticScene scene;
    scene.touchable = std::make_shared<SpringSurface>(shape, 500.0, 0.0);
    scene.id = id;
    return scene;
  };
  HapticScene deep = scene_of([](double, double) { return SpringSurface::Height{-0.5}; }, 1);
  const std::weak_ptr<const Touchable> old = deep.touchable;
  auto loop =
      ServoLoop::start(std::make_unique<LoggingDevice>(log), std::move(deep), quiet(), std::move(further));
  ASSERT_TRUE(loop);
  const std::optional<Point<DeviceFrame>> place{{{-0.02, 0.0, -0.001}}};
  ASSERT_TRUE(wait_for(**loop, 1, *feed, place, [](const TouchSample& s) { return is_present(s); }));
  // 5 mm above the probe alone: it rises for more than 0.1 s, while the hand's fade takes 2 ms.
  (*loop)->change(
      scene_of([](double x, double) { return SpringSurface::Height{x < -0.01 ? 0.004 : -0.5}; }, 2));
  while (!old.expired()) {
    feed->put(place);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const auto after = wait_for(**loop, 1, *feed, place, is_present);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->scene_id, 2U) << "its scene was freed";
  (*loop)->stop();
}

TEST(ServoLoop, ChangesTheSceneOfAbsentProbesToo) {
  Log log;
  std::atomic<int> alive{0};
  auto feed = std::make_shared<device::PointerFeed>();
  std::vector<std::unique_ptr<device::Device>> further;
  further.push_back(probe_of(feed));
  auto loop = ServoLoop::start(std::make_unique<LoggingDevice>(log), counted(alive, 1.0, 1), quiet(),
                               std::move(further));
  ASSERT_TRUE(loop);
  for (std::uint32_t id = 2; id < 20; ++id) {
    (*loop)->change(counted(alive, 0.1 * id, id));
    const bool comes = id % 2 == 0;
    const auto place = comes ? std::optional(Point<DeviceFrame>{{0.0, 0.0, -0.001}}) : std::nullopt;
    const auto there = wait_for(**loop, 1, *feed, place, [&](const TouchSample& s) {
      return s.scene_id == id && is_present(s) == comes &&
             (!comes || std::abs(s.written_force_N.v.z - 0.1 * id) < 1e-6);
    });
    ASSERT_TRUE(there) << id;
  }
  // The first scenes are freed, and no probe used them any more.
  (*loop)->stop();
  EXPECT_LE(alive, 1);
}

}  // namespace
}  // namespace palpable::haptics
