// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/open_haptics/open_haptics.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/core/system/shared_library.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/virtual/moved_handle.hpp"

#include <chrono>
#include <random>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

/// The test's side of the virtual library.
struct HdBench {
  void (*reset)() = nullptr;
  void (*run)() = nullptr;
  void (*call)() = nullptr;
  void (*inject)(int) = nullptr;
  void (*pull_to)(double, double, double) = nullptr;
  void (*press)(int) = nullptr;
  void (*force)(double*, double*, double*) = nullptr;
  int (*is_open)() = nullptr;
  unsigned (*updated_by)() = nullptr;
  void (*fail)(unsigned) = nullptr;
};

class TouchDevice : public testing::Test {
 protected:
  void SetUp() override {
    const auto library = SharedLibrary::open(PALPABLE_VIRTUAL_HD, {});
    ASSERT_TRUE(library) << library.error().sentence();
    ASSERT_TRUE(library->bind(bench_.reset, "virtual_hd_reset"));
    ASSERT_TRUE(library->bind(bench_.run, "virtual_hd_run"));
    ASSERT_TRUE(library->bind(bench_.call, "virtual_hd_call"));
    ASSERT_TRUE(library->bind(bench_.inject, "virtual_hd_inject"));
    ASSERT_TRUE(library->bind(bench_.pull_to, "virtual_hd_pull_to"));
    ASSERT_TRUE(library->bind(bench_.press, "virtual_hd_press"));
    ASSERT_TRUE(library->bind(bench_.force, "virtual_hd_force"));
    ASSERT_TRUE(library->bind(bench_.is_open, "virtual_hd_is_open"));
    ASSERT_TRUE(library->bind(bench_.updated_by, "virtual_hd_updated_by"));
    ASSERT_TRUE(library->bind(bench_.fail, "virtual_hd_fail"));
    bench_.reset();
  }
  static Result<std::unique_ptr<Device>> open(const std::string& name = {}, const std::string& options = {}) {
    OpenOptions here;
    here.vendor_library = VendorLibrary::here;
    return open_device("touch:" + name + "?library=" PALPABLE_VIRTUAL_HD + options, here);
  }
  void inject(LibraryFault fault) const { bench_.inject(static_cast<int>(fault)); }
  Vec3 motors() const {
    Vec3 held;
    bench_.force(&held.x, &held.y, &held.z);
    return held;
  }
  /// Ticks of the servo, each followed by a call of the library's thread.
  Reading ticks(Device& device, int count, Vec3 force_N = {}) const {
    Reading reading;
    for (int k = 0; k < count; ++k) {
      reading = device.read();
      device.write({force_N});
      bench_.call();
    }
    return reading;
  }
  HdBench bench_;
};

TEST_F(TouchDevice, ReadsMillimetresFromTheMiddleOfItsWorkspace) {
  const auto device = open();
  ASSERT_TRUE(device) << device.error().sentence();
  EXPECT_NEAR((*device)->traits().workspace_m.x, 0.16, 1e-12);
  EXPECT_NEAR((*device)->traits().workspace_m.y, 0.12, 1e-12);
  EXPECT_NEAR((*device)->traits().workspace_m.z, 0.07, 1e-12);
  EXPECT_EQ((*device)->traits().name, "Virtual Touch");
  EXPECT_EQ((*device)->traits().max_force_N, 3.3);
  bench_.pull_to(0.03, -0.02, 0.01);
  const Reading reading = ticks(**device, 2000);
  EXPECT_EQ(reading.status, Status::ok);
  EXPECT_NEAR(reading.position.v.x, 0.03, 2e-5);
  EXPECT_NEAR(reading.position.v.y, -0.02, 2e-5);
  EXPECT_NEAR(reading.position.v.z, 0.01, 2e-5);
}

TEST_F(TouchDevice, WritesTheNewestForce) {
  const auto device = open("Left", "&max-force=2");
  ASSERT_TRUE(device);
  EXPECT_EQ((*device)->traits().max_force_N, 2.0);
  ticks(**device, 3);
  ticks(**device, 1, {0.1, 0.2, 0.3});
  EXPECT_EQ(motors(), (Vec3{0.1, 0.2, 0.3}));
  bench_.press(2);
  EXPECT_EQ(ticks(**device, 2).buttons, 2U);
}

TEST_F(TouchDevice, SaysThatTheLibraryFindsItsMotorsWarmOrTheForceTooGreat) {
  const auto device = open();
  ASSERT_TRUE(device);
  constexpr unsigned kWarm = 0x0200, kExceeded = 0x0201;
  ticks(**device, 3, {0.5, 0.0, 0.0});
  EXPECT_EQ((*device)->guidance(), "");
  bench_.fail(kWarm);
  // It goes on, and says so until it has not happened for two seconds.
  EXPECT_EQ(ticks(**device, 1000, {0.5, 0.0, 0.0}).status, Status::ok);
  EXPECT_EQ(motors(), (Vec3{0.5, 0.0, 0.0}));
  EXPECT_NE((*device)->guidance().find("motors are warm"), std::string::npos);
  bench_.fail(kExceeded);
  ticks(**device, 1000, {0.5, 0.0, 0.0});
  EXPECT_NE((*device)->guidance().find("Exceeded max force"), std::string::npos) << (*device)->guidance();
  ticks(**device, 1001, {0.5, 0.0, 0.0});
  EXPECT_EQ((*device)->guidance(), "");
}

TEST_F(TouchDevice, IsFreeAfterFiveCallsWithoutTheServo) {
  const auto device = open();
  ASSERT_TRUE(device);
  ticks(**device, 10, {0.5, 0.0, 0.0});
  EXPECT_NE(motors(), Vec3{});
  for (int k = 0; k < 5; ++k) bench_.call();
  EXPECT_EQ(motors(), Vec3{});
  // It does not come back at once: the tick learns of it, so that its force begins from zero.
  for (int k = 0; k < 25; ++k) {
    EXPECT_EQ(ticks(**device, 1, {0.5, 0.0, 0.0}).status, Status::stale) << k;
    EXPECT_EQ(motors(), Vec3{}) << k;
  }
  EXPECT_EQ(ticks(**device, 2, {0.5, 0.0, 0.0}).status, Status::ok);
  EXPECT_NE(motors(), Vec3{});
}

TEST_F(TouchDevice, NeverGetsItsForceBackInOneStep) {
  const auto device = open();
  ASSERT_TRUE(device);
  // A call without the servo, and bursts of them, at random.
  std::mt19937 random(4);
  Vec3 before;
  int rests = 0;
  double wanted_N = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const Reading reading = (*device)->read();
    // A tick's force rises by 0.3 N from zero, and is zero while the reading is not good.
    wanted_N = reading.status == Status::ok ? std::min(3.0, wanted_N + 0.3) : 0.0;
    (*device)->write({{wanted_N, 0.0, 0.0}});
    const int calls = random() % 100 == 0 ? static_cast<int>(random() % 12) : 1;
    for (int call = 0; call < calls; ++call) {
      bench_.call();
      EXPECT_LE(motors().x, before.x + 0.3 + 1e-9) << k;
      before = motors();
    }
    rests += reading.status == Status::ok ? 0 : 1;
  }
  EXPECT_GT(rests, 100);
}

TEST_F(TouchDevice, TakesNoForceOfBeforeACut) {
  const auto device = open();
  ASSERT_TRUE(device);
  ticks(**device, 10, {0.5, 0.0, 0.0});
  (*device)->cut_force();
  bench_.call();
  EXPECT_EQ(motors(), Vec3{});
  ticks(**device, 1, {0.5, 0.0, 0.0});
  EXPECT_NE(motors(), Vec3{});
}

TEST_F(TouchDevice, GetsNoForceBeforeItIsCalibrated) {
  inject(LibraryFault::uncalibrated);
  const auto device = open();
  ASSERT_TRUE(device);
  EXPECT_EQ(ticks(**device, 300, {0.5, 0.0, 0.0}).status, Status::not_ready);
  EXPECT_EQ(motors(), Vec3{});
  // By the well: encoders are never reset at an unknown place.
  EXPECT_EQ(bench_.updated_by(), hd::kInkwell);
  inject(LibraryFault::none);
  EXPECT_FALSE((*device)->guidance().empty());
  EXPECT_EQ(ticks(**device, 102, {0.5, 0.0, 0.0}).status, Status::ok);
  EXPECT_NE(motors(), Vec3{});
  EXPECT_TRUE((*device)->guidance().empty());
  // Lost in the middle of a touch.
  inject(LibraryFault::uncalibrated);
  EXPECT_EQ(ticks(**device, 102, {0.5, 0.0, 0.0}).status, Status::not_ready);
  EXPECT_EQ(motors(), Vec3{});
}

TEST_F(TouchDevice, HasFailedAfterHalfASecondAndSaysSo) {
  const auto device = open();
  ASSERT_TRUE(device);
  ticks(**device, 20);
  inject(LibraryFault::unplugged);
  EXPECT_EQ(ticks(**device, 520).status, Status::fault);
  EXPECT_EQ((*device)->fault(), "the Virtual Touch failed (Device fault)");
}

TEST_F(TouchDevice, IsNotThereWhereNoneHasItsName) {
  EXPECT_EQ(open("Right").error().code, ErrorCode::device);
  EXPECT_NE(open("Right").error().message.find("with the name Right (Device fault)"), std::string::npos);
  EXPECT_EQ(open("", "&max-force=-1").error().code, ErrorCode::usage);
}

TEST_F(TouchDevice, FreesItsMotorsWhenItIsClosedWhileTheLibraryRuns) {
  bench_.run();
  auto device = open();
  ASSERT_TRUE(device);
  for (int k = 0; k < 200 && motors() == Vec3{}; ++k) {
    (*device)->read();
    (*device)->write({{0.2, 0.0, 0.0}});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_NE(motors(), Vec3{});
  device->reset();
  EXPECT_EQ(motors(), Vec3{});
  EXPECT_EQ(bench_.is_open(), 0);
}

TEST_F(TouchDevice, NeitherAllocatesNorStopsInATick) {
  ASSERT_TRUE(allocations_are_counted());
  const auto device = open();
  ASSERT_TRUE(device);
  const AllocationScope scope;
  ticks(**device, 1000, {0.1, 0.0, 0.0});
  (*device)->stop();
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::device
