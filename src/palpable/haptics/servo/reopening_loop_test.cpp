// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/reopening_loop.hpp"

#include "palpable/device/callback_device.hpp"
#include "palpable/haptics/servo/test_touch.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// What stays of a device that is unplugged and plugged in again.
struct Plug {
  std::atomic<bool> plugged{true};
  std::atomic<int> open{0};
  std::atomic<int> opened{0};
  std::atomic<double> force_N{0.0};
};

/// Its handle is held 2 mm deep in a wall.
class PluggedDevice final : public device::Device {
 public:
  explicit PluggedDevice(Plug& plug) : plug_(plug) {
    traits_.name = "plugged";
    EXPECT_EQ(++plug_.open, 1) << "opened while the failed one was still open";
    ++plug_.opened;
  }
  ~PluggedDevice() override { --plug_.open; }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    // Once it was unplugged, this one never works again.
    gone_ = gone_ || !plug_.plugged;
    device::Reading reading;
    reading.position.v.z = -0.002;
    reading.status = gone_ ? device::Status::fault : device::Status::ok;
    return reading;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override { plug_.force_N = gone_ ? 0.0 : norm(force_N); }
  void stop() noexcept override { plug_.force_N = 0.0; }
  std::string fault() const override { return "it was unplugged"; }

 private:
  Plug& plug_;
  device::Traits traits_;
  bool gone_ = false;
};

template <class Condition>
bool wait_until(Condition&& condition) {
  using Clock = std::chrono::steady_clock;
  for (const auto until = Clock::now() + std::chrono::seconds(20); Clock::now() < until;
       std::this_thread::sleep_for(std::chrono::milliseconds(2)))
    if (condition()) return true;
  return false;
}

ServoOptions unprivileged_servo() {
  ServoOptions options;
  options.realtime_priority = 0;
  options.memory = Memory::leave;
  return options;
}

std::shared_ptr<const Touchable> a_wall() {
  return std::make_shared<SpringSurface>([](double, double) { return SpringSurface::Height{}; }, 300.0, 1.0);
}

TEST(ReopeningLoop, ResumesWithARampWhenAnUnpluggedDeviceIsBack) {
  Plug plug;
  const auto open = [&]() -> Result<std::unique_ptr<device::Device>> {
    if (!plug.plugged) return Error{ErrorCode::device, "is not there", "plugged"};
    return std::unique_ptr<device::Device>(std::make_unique<PluggedDevice>(plug));
  };
  HapticScene scene;
  scene.touchable = a_wall();
  auto started = ReopeningLoop::start(*open(), scene, unprivileged_servo(), open);
  ASSERT_TRUE(started) << started.error().sentence();
  ReopeningLoop& loop = **started;
  // 300 N/m at 2 mm.
  ASSERT_TRUE(wait_until([&] { return plug.force_N > 0.59; }));
  const double before_N = plug.force_N;

  plug.plugged = false;
  ASSERT_TRUE(wait_until([&] { return plug.open == 0; }));
  EXPECT_EQ(plug.force_N, 0.0);
  EXPECT_EQ(loop.device_fault(), "it was unplugged");
  EXPECT_NE(loop.device_guidance().find("opened again"), std::string::npos);
  EXPECT_FALSE(loop.take_latest());
  EXPECT_GT(loop.statistics().touch.ticks, 0U);

  plug.plugged = true;
  ASSERT_TRUE(wait_until([&] { return loop.reopened() == 1; }));
  ASSERT_TRUE(wait_until([&] { return plug.force_N > 0.9 * before_N; }));
  EXPECT_EQ(plug.opened, 2);
  // The ramp of the new loop: its first samples have less force than the last.
  const auto sample = loop.take_latest();
  ASSERT_TRUE(sample);
  EXPECT_GE(sample->t_s, 0.1) << "the force was complete before the ramp could be";
  const auto event = loop.take_event();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, TouchEvent::Kind::recovered);
}

TEST(ReopeningLoop, DoesNotContinueWithAnotherKindOfDevice) {
  Plug plug;
  int opened = 0;
  const auto open = [&]() -> Result<std::unique_ptr<device::Device>> {
    if (++opened == 1) return std::unique_ptr<device::Device>(std::make_unique<PluggedDevice>(plug));
    device::Traits other;
    other.degrees_of_freedom = 2;
    return std::unique_ptr<device::Device>(std::make_unique<device::CallbackDevice>(
        other, [] { return device::Reading{}; }, [](Vector<DeviceFrame>) {}));
  };
  HapticScene scene;
  scene.touchable = a_wall();
  auto started = ReopeningLoop::start(*open(), scene, unprivileged_servo(), open);
  ASSERT_TRUE(started);
  plug.plugged = false;
  EXPECT_TRUE(
      wait_until([&] { return (*started)->device_fault().find("is another one") != std::string::npos; }));
  EXPECT_EQ((*started)->reopened(), 0);
}

}  // namespace
}  // namespace palpable::haptics
