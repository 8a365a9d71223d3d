// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/evdev/evdev.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/virtual/virtual_joystick.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

struct Stick {
  explicit Stick(bool pushes = true) {
    auto made = std::make_unique<VirtualJoystick>(pushes);
    port = made.get();
    device = std::make_unique<EvdevDevice>(std::move(made), EvdevOptions{});
  }
  Reading ticks(int count, Vec3 force_N) {
    Reading reading;
    for (int k = 0; k < count; ++k) {
      reading = device->read();
      device->write({force_N});
      port->pass_millisecond();
    }
    return reading;
  }
  VirtualJoystick* port = nullptr;
  std::unique_ptr<EvdevDevice> device;
};

TEST(Evdev, ReadsItsAxesInTheWorkspace) {
  Stick stick;
  stick.port->happen(EV_ABS, ABS_X, 511);
  stick.port->happen(EV_ABS, ABS_Y, 0);
  stick.port->happen(EV_KEY, BTN_JOYSTICK + 2, 1);
  const Reading reading = stick.ticks(1, {});
  EXPECT_NEAR(reading.position.v.x, 0.05, 1e-12);
  EXPECT_NEAR(reading.position.v.y, 0.05, 1e-12);
  EXPECT_EQ(reading.buttons, 4U);
  EXPECT_TRUE(check(stick.device->traits()));
  // Values beyond the range that the kernel stated.
  stick.port->happen(EV_ABS, ABS_X, -2'000'000'000);
  EXPECT_NEAR(stick.ticks(1, {}).position.v.x, -0.05, 1e-12);
}

TEST(Evdev, StatesThePeriodOfItsStick) {
  EvdevOptions options;
  options.sensor_period_s = 0.008;
  const EvdevDevice device(std::make_unique<VirtualJoystick>(true), options);
  EXPECT_EQ(device.traits().sensor_period_s, 0.008);
  EXPECT_TRUE(check(device.traits()));
}

TEST(Evdev, ReadsWhatItsEventsDidNotSay) {
  auto held = std::make_unique<VirtualJoystick>(true);
  held->overflow(EV_ABS, ABS_Y, 0);
  EXPECT_NEAR(EvdevDevice(std::move(held), EvdevOptions{}).read().position.v.y, 0.05, 1e-12);

  Stick stick;
  stick.port->happen(EV_KEY, BTN_JOYSTICK, 1);
  EXPECT_EQ(stick.ticks(1, {}).buttons, 1U);
  stick.port->overflow(EV_KEY, BTN_JOYSTICK, 0);
  const Reading reading = stick.ticks(1, {});
  EXPECT_EQ(reading.buttons, 0U);
  EXPECT_NEAR(reading.position.v.x, 0.0, 1e-4);
}

TEST(Evdev, PushesInEveryDirection) {
  Stick stick;
  for (int k = 0; k < 16; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 16.0;
    const Vec3 force{std::cos(angle), std::sin(angle), 0.3};
    stick.ticks(10, force);
    EXPECT_NEAR(stick.port->push().x, 0.5 * force.x, 2e-4) << k;
    EXPECT_NEAR(stick.port->push().y, 0.5 * force.y, 2e-4) << k;
  }
}

TEST(Evdev, SendsAnEffectAtMostEveryFourMilliseconds) {
  Stick stick;
  stick.ticks(1000, {1.0, 0.0, 0.0});
  EXPECT_LE(stick.port->uploads(), 251);
  EXPECT_GE(stick.port->uploads(), 240);
}

TEST(Evdev, ReleasesAtOnceAndByItselfIfNobodyWrites) {
  Stick stick;
  stick.ticks(10, {1.0, 0.0, 0.0});
  stick.ticks(1, {});
  EXPECT_EQ(stick.port->push(), Vec3{});
  stick.ticks(10, {1.0, 0.0, 0.0});
  EXPECT_NE(stick.port->push(), Vec3{});
  for (int k = 0; k < EvdevDevice::kEffectLasts_ms; ++k) stick.port->pass_millisecond();
  EXPECT_EQ(stick.port->push(), Vec3{});
  stick.ticks(5, {1.0, 0.0, 0.0});
  stick.device->stop();
  EXPECT_EQ(stick.port->push(), Vec3{});
  EXPECT_NE(stick.ticks(5, {1.0, 0.0, 0.0}).status, Status::fault);
  EXPECT_NE(stick.port->push(), Vec3{});
}

TEST(Evdev, RumblesWhereItCannotPush) {
  Stick pad(false);
  EXPECT_FALSE(pad.device->traits().pushes_back);
  pad.ticks(5, {0.6, 0.8, 0.0});
  EXPECT_NEAR(pad.port->rumble(), 0.5, 1e-4);
  pad.ticks(1, {});
  EXPECT_EQ(pad.port->rumble(), 0.0);
}

TEST(Evdev, SaysThatItWasUnplugged) {
  Stick stick;
  stick.port->unplug();
  EXPECT_EQ(stick.ticks(3, {1.0, 0.0, 0.0}).status, Status::fault);
  EXPECT_EQ(stick.device->fault(), "the Virtual stick was unplugged");
}

TEST(Evdev, AsksAgainIfAnEffectWasRefused) {
  Stick stick;
  stick.port->refuse();
  EXPECT_EQ(stick.ticks(5, {1.0, 0.0, 0.0}).status, Status::ok);
  EXPECT_EQ(stick.port->push(), Vec3{});
}

TEST(Evdev, NamesWhatIsWrongWithItsAddress) {
  EXPECT_EQ(open_device("evdev:/nowhere/event0", {}).error().code, ErrorCode::device);
  EXPECT_EQ(open_device("evdev:/dev/null", {}).error().message, "is no joystick: it has no axes X and Y");
  EXPECT_EQ(open_device("evdev:?size-mm=0", {}).error().code, ErrorCode::usage);
}

TEST(Evdev, NeitherAllocatesNorWaitsInATick) {
  ASSERT_TRUE(allocations_are_counted());
  Stick stick;
  const AllocationScope scope;
  stick.ticks(1000, {1.0, 0.2, 0.0});
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::device
