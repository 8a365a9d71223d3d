// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/force_dimension/force_dimension.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/core/system/shared_library.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/transport/vendor_text.hpp"
#include "palpable/device/virtual/moved_handle.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace palpable::device {
namespace {

/// The test's side of the virtual library.
struct DhdBench {
  void (*reset)() = nullptr;
  void (*inject)(int) = nullptr;
  void (*pull_to)(double, double, double) = nullptr;
  void (*press)(int) = nullptr;
  void (*force)(double*, double*, double*) = nullptr;
  int (*is_open)() = nullptr;
  int (*is_initialised)() = nullptr;
};

class ForceDimensionDevice : public testing::Test {
 protected:
  void SetUp() override {
    const auto library = SharedLibrary::open(PALPABLE_VIRTUAL_DHD, {});
    ASSERT_TRUE(library) << library.error().sentence();
    ASSERT_TRUE(library->bind(bench_.reset, "virtual_dhd_reset"));
    ASSERT_TRUE(library->bind(bench_.inject, "virtual_dhd_inject"));
    ASSERT_TRUE(library->bind(bench_.pull_to, "virtual_dhd_pull_to"));
    ASSERT_TRUE(library->bind(bench_.press, "virtual_dhd_press"));
    ASSERT_TRUE(library->bind(bench_.force, "virtual_dhd_force"));
    ASSERT_TRUE(library->bind(bench_.is_open, "virtual_dhd_is_open"));
    ASSERT_TRUE(library->bind(bench_.is_initialised, "virtual_dhd_is_initialised"));
    bench_.reset();
  }
  Result<std::unique_ptr<Device>> open(const std::string& options = {}) {
    OpenOptions here;
    here.vendor_library = VendorLibrary::here;
    return open_device("forcedimension:?library=" PALPABLE_VIRTUAL_DHD + options, here);
  }
  void inject(LibraryFault fault) { bench_.inject(static_cast<int>(fault)); }
  /// The motors' force in our frame.
  Vec3 motors() const {
    Vec3 theirs;
    bench_.force(&theirs.x, &theirs.y, &theirs.z);
    return {theirs.y, theirs.z, theirs.x};
  }
  DhdBench bench_;
};

Reading dhd_ticks(Device& device, int count, Vec3 force_N = {}) {
  Reading reading;
  for (int k = 0; k < count; ++k) {
    reading = device.read();
    device.write({force_N});
  }
  return reading;
}

TEST_F(ForceDimensionDevice, TurnsTheVendorsAxesIntoOurs) {
  const auto device = open();
  ASSERT_TRUE(device) << device.error().sentence();
  // 30 mm towards the user, 20 mm to the right, 10 mm up.
  bench_.pull_to(0.03, 0.02, 0.01);
  const Reading reading = dhd_ticks(**device, 2000);
  EXPECT_EQ(reading.status, Status::ok);
  EXPECT_NEAR(reading.position.v.x, 0.02, 2e-5);
  EXPECT_NEAR(reading.position.v.y, 0.01, 2e-5);
  EXPECT_NEAR(reading.position.v.z, 0.03, 2e-5);
  (*device)->write({{1.0, 2.0, 3.0}});
  EXPECT_EQ(motors(), (Vec3{1.0, 2.0, 3.0}));
}

TEST_F(ForceDimensionDevice, TellsItsLimits) {
  const auto device = open("&max-force=5");
  ASSERT_TRUE(device);
  EXPECT_EQ((*device)->traits().name, "omega.3");
  EXPECT_EQ((*device)->traits().max_force_N, 5.0);
  EXPECT_TRUE(check((*device)->traits()));
  EXPECT_EQ(bench_.is_initialised(), 1);
}

TEST_F(ForceDimensionDevice, NeverGetsMoreForceThanTheLibraryStates) {
  const auto device = open("&max-force=40");
  ASSERT_TRUE(device);
  EXPECT_EQ((*device)->traits().max_force_N, 12.0);
}

TEST_F(ForceDimensionDevice, ReadsItsButtons) {
  const auto device = open("&initialise=no");
  ASSERT_TRUE(device);
  EXPECT_EQ(bench_.is_initialised(), 0);
  bench_.press(5);
  EXPECT_EQ((*device)->read().buttons, 5U);
}

TEST_F(ForceDimensionDevice, FreesItsMotorsWhenItIsStoppedAndWhenItIsClosed) {
  auto device = open();
  ASSERT_TRUE(device);
  dhd_ticks(**device, 10, {0.5, 0.0, 0.0});
  EXPECT_NE(motors(), Vec3{});
  (*device)->stop();
  EXPECT_EQ(motors(), Vec3{});
  dhd_ticks(**device, 10, {0.5, 0.0, 0.0});
  device->reset();
  EXPECT_EQ(motors(), Vec3{});
  EXPECT_EQ(bench_.is_open(), 0);
}

TEST_F(ForceDimensionDevice, HasFailedAfterHalfASecondAndSaysSo) {
  const auto device = open();
  ASSERT_TRUE(device);
  dhd_ticks(**device, 20);
  inject(LibraryFault::unplugged);
  EXPECT_EQ(dhd_ticks(**device, 520).status, Status::fault);
  EXPECT_EQ((*device)->fault(), "the omega.3 gives no valid position any more (no device found)");
}

TEST_F(ForceDimensionDevice, IsNotThereWhereNoneIsPluggedIn) {
  inject(LibraryFault::absent);
  EXPECT_EQ(open().error().code, ErrorCode::device);
  inject(LibraryFault::uncalibrated);
  EXPECT_NE(open().error().message.find("find its position"), std::string::npos);
  // With the device closed again.
  EXPECT_EQ(bench_.is_open(), 0);
}

TEST_F(ForceDimensionDevice, NamesWhatIsWrongWithItsAddress) {
  EXPECT_EQ(open_device("forcedimension:x", {}).error().code, ErrorCode::usage);
  EXPECT_EQ(open_device("forcedimension:99", {}).error().code, ErrorCode::usage);
  EXPECT_EQ(open("&initialise=perhaps").error().code, ErrorCode::usage);
  const auto other = open_device("forcedimension:3?library=" PALPABLE_VIRTUAL_DHD, {});
  EXPECT_NE(other.error().message.find("there is no device 3"), std::string::npos);
}

TEST(VendorsLibrary, HasNamesThatCanBeShownAndForcesThatADeviceHas) {
  EXPECT_EQ(vendor_text("omega.3", "x"), "omega.3");
  for (const char* text : {static_cast<const char*>(nullptr), "", "\033[31mred", "om\xff", "two\nlines"})
    EXPECT_EQ(vendor_text(text, "a device"), "a device");
  EXPECT_EQ(vendor_text(std::string(65, 'x').c_str(), "a device"), "a device");
  for (const double stated_N : {0.0, -5.0, 1e9, static_cast<double>(NAN)})
    EXPECT_EQ(vendor_force_N(stated_N, 8.0), 8.0);
  EXPECT_EQ(vendor_force_N(12.0, 8.0), 12.0);
  EXPECT_EQ(vendor_force_N(200.0, 8.0), 40.0);
}

TEST(VendorsLibrary, IsNamedIfItIsMissingOrOfAnotherKind) {
  EXPECT_EQ(SharedLibrary::open({}, {"libnowhere.so"}).error().message,
            "the vendor's library libnowhere.so is not installed");
  const auto text = open_device("forcedimension:?library=/etc/passwd", {});
  EXPECT_EQ(text.error().code, ErrorCode::device);
  EXPECT_NE(text.error().message.find("cannot be loaded"), std::string::npos);
  const auto other = open_device("forcedimension:?library=" PALPABLE_VIRTUAL_HD, {});
  EXPECT_NE(other.error().message.find("has no function dhd"), std::string::npos);
}

TEST(VendorsLibrary, IsRefusedIfItIsCutOffOrAPipe) {
  std::ifstream whole(PALPABLE_VIRTUAL_DHD, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  const std::filesystem::path folder(::testing::TempDir());
  for (const std::size_t left : {std::size_t{3}, std::size_t{40}, std::size_t{100}, std::size_t{3000}}) {
    ASSERT_LT(left, bytes.size());
    const auto path = folder / "libcut.so";
    std::ofstream(path, std::ios::binary) << bytes.substr(0, left);
    const auto cut = open_device("forcedimension:?library=" + path.string(), {});
    ASSERT_FALSE(cut) << left;
    EXPECT_EQ(cut.error().code, ErrorCode::device);
  }
  const auto pipe = folder / "pipe.so";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto waited = open_device("touch:?library=" + pipe.string(), {});
  EXPECT_NE(waited.error().message.find("is no regular file"), std::string::npos);
}

TEST_F(ForceDimensionDevice, NeitherAllocatesNorStopsInATick) {
  ASSERT_TRUE(allocations_are_counted());
  const auto device = open();
  ASSERT_TRUE(device);
  const AllocationScope scope;
  dhd_ticks(**device, 1000, {0.1, 0.0, 0.0});
  (*device)->stop();
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::device
