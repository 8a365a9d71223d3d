// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Vendors' libraries that exit, abort, crash or hang, in a host of their own. In real time, without any limit
// that a busy machine could miss.
#include "palpable/device/hosted/hosted_device.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/virtual/library_board.hpp"

#include <chrono>
#include <csignal>
#include <functional>
#include <iostream>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::device {
namespace {

using testing::HasSubstr;

constexpr double kPush_N = 0.5;

/// A virtual library in a host, and the board behind it.
class Hosted : public testing::Test {
 protected:
  Hosted() {
    ::unlink(file_.c_str());
    ::setenv(LibraryBoard::kVariable, file_.c_str(), 1);
    board_ = share_board(file_.c_str());
  }
  ~Hosted() override {
    ::unsetenv(LibraryBoard::kVariable);
    ::munmap(board_, sizeof(LibraryBoard));
    ::unlink(file_.c_str());
  }
  static Result<std::unique_ptr<Device>> open(const std::string& scheme) {
    const std::string library = scheme == "touch" ? PALPABLE_VIRTUAL_HD : PALPABLE_VIRTUAL_DHD;
    return open_device(scheme + ":?patience=1&library=" + library, {});
  }
  void misbehave(VendorCall where, Misdeed what, int times = 1) const {
    board_->times = 0;
    board_->what = what;
    board_->where = where;
    board_->times = times;
  }
  /// Ticks of a servo that pushes, until `done` says so of its reading; false: not within 20 s.
  static bool tick_until(Device& device, const std::function<bool(const Reading&)>& done) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (std::chrono::steady_clock::now() < until) {
      const Reading reading = device.read();
      if (done(reading)) return true;
      device.write({{kPush_N, kPush_N, kPush_N}});
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  bool push(Device& device) const {
    return tick_until(device, [&](const Reading& reading) {
      return reading.status == Status::ok && board_->held() == Vec3{kPush_N, kPush_N, kPush_N};
    });
  }
  bool becomes_free() const {
    for (int k = 0; k < 10000 && board_->held() != Vec3{}; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return board_->held() == Vec3{};
  }
  std::string file_ = testing::TempDir() + "board" + std::to_string(::getpid());
  LibraryBoard* board_;
};

TEST_F(Hosted, LibraryServesItsDevice) {
  for (const std::string scheme : {"forcedimension", "touch"}) {
    const auto device = open(scheme);
    ASSERT_TRUE(device) << device.error().sentence();
    EXPECT_EQ((*device)->traits().name, scheme == "touch" ? "Virtual Touch" : "omega.3");
    EXPECT_TRUE(push(**device));
    // In the axes of the library.
    board_->goal_m.put({0.02, 0.02, 0.02});
    EXPECT_TRUE(tick_until(**device, [](const Reading& reading) { return reading.position.v.x > 0.015; }));
    (*device)->stop();
    EXPECT_TRUE(becomes_free());
  }
}

TEST_F(Hosted, TicksAllocateNothing) {
  ASSERT_TRUE(allocations_are_counted());
  const auto device = open("forcedimension");
  ASSERT_TRUE(device) << device.error().sentence();
  const AllocationScope scope;
  for (int k = 0; k < 100; ++k) {
    (*device)->read();
    (*device)->write({{0.1, 0.0, 0.0}});
  }
  EXPECT_EQ(scope.count(), 0U);
}

TEST_F(Hosted, MotorsAreFreeWhileTheServoStandsStillAndBeginFromZero) {
  const auto device = open("forcedimension");
  ASSERT_TRUE(device) << device.error().sentence();
  ASSERT_TRUE(push(**device));
  ASSERT_TRUE(becomes_free());
  EXPECT_EQ((*device)->read().status, Status::stale);
  (*device)->write({{kPush_N, 0.0, 0.0}});
  EXPECT_TRUE(push(**device));
}

TEST_F(Hosted, MotorsAreFreeAfterTheProgramWasKilled) {
  for (const char* scheme : {"forcedimension", "touch"}) {
    const pid_t program = ::fork();
    if (program == 0) {
      const auto device = open(scheme);
      tick_until(**device, [](const Reading& /*reading*/) { return false; });
      ::_exit(0);
    }
    for (int k = 0; k < 10000 && board_->held() == Vec3{}; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_NE(board_->held(), Vec3{});
    ::kill(program, SIGKILL);
    const auto killed = std::chrono::steady_clock::now();
    EXPECT_TRUE(becomes_free());
    std::cout << scheme << ": free after "
              << std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - killed).count()
              << " ms\n";
    ::waitpid(program, nullptr, 0);
  }
}

TEST_F(Hosted, LibraryThatAlwaysCrashesIsSaidToHoldAForce) {
  const auto device = open("forcedimension");
  ASSERT_TRUE(device) << device.error().sentence();
  ASSERT_TRUE(push(**device));
  misbehave(VendorCall::forcing, Misdeed::crashes, 100);
  EXPECT_TRUE(tick_until(**device, [](const Reading& reading) { return reading.status == Status::fault; }));
  EXPECT_THAT((*device)->fault(), HasSubstr("switch the device off"));
}

TEST_F(Hosted, LibraryIsNotBelievedToBeOneInAnotherProgram) {
  ::setenv("PALPABLE_LIBRARY_HOST", "/bin/cat", 1);
  const auto device = open("touch");
  ::unsetenv("PALPABLE_LIBRARY_HOST");
  ASSERT_FALSE(device);
  EXPECT_THAT(device.error().message, HasSubstr("is no library host of this version"));
}

struct Case {
  const char* scheme;
  Misdeed what;
  const char* words;
};

const char* name_of(Misdeed what) {
  return what == Misdeed::exits     ? "exits"
         : what == Misdeed::aborts  ? "aborts"
         : what == Misdeed::crashes ? "crashes"
                                    : "hangs";
}

class HostedLibrary : public Hosted, public testing::WithParamInterface<Case> {};

TEST_P(HostedLibrary, FailsWhileItsDeviceIsOpened) {
  misbehave(VendorCall::opening, GetParam().what);
  const auto device = open(GetParam().scheme);
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().code, ErrorCode::device);
  EXPECT_THAT(device.error().message,
              HasSubstr(GetParam().what == Misdeed::hangs ? "does not return within 1 s"
                                                          : std::string(GetParam().words) + " while"));
}

TEST_P(HostedLibrary, FailsInATouchAndItsMotorsAreFree) {
  for (const VendorCall where : {VendorCall::reading, VendorCall::forcing}) {
    const auto device = open(GetParam().scheme);
    ASSERT_TRUE(device) << device.error().sentence();
    ASSERT_TRUE(push(**device));
    // Also the call of the host's other thread hangs, by which it tries to free the motors.
    const bool hangs_twice = where == VendorCall::forcing && GetParam().what == Misdeed::hangs &&
                             std::string_view(GetParam().scheme) == "forcedimension";
    misbehave(where, GetParam().what, hangs_twice ? 2 : 1);
    const auto begun = std::chrono::steady_clock::now();
    double free_ms = -1.0;
    EXPECT_TRUE(tick_until(**device, [&](const Reading& reading) {
      if (free_ms < 0.0 && board_->held() == Vec3{})
        free_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
      return reading.status == Status::fault;
    }));
    EXPECT_TRUE(becomes_free());
    EXPECT_THAT((*device)->fault(), HasSubstr(GetParam().words));
    EXPECT_EQ((*device)->read().status, Status::fault);
    std::cout << "free after " << free_ms << " ms: " << (*device)->fault() << "\n";
    misbehave(VendorCall::none, Misdeed::none, 0);
    // And the device can be opened again.
    EXPECT_TRUE(open(GetParam().scheme));
  }
}

TEST_P(HostedLibrary, FailsWhileItsDeviceIsClosedWithoutForce) {
  auto device = open(GetParam().scheme);
  ASSERT_TRUE(device) << device.error().sentence();
  ASSERT_TRUE(push(**device));
  misbehave(VendorCall::closing, GetParam().what);
  device->reset();
  EXPECT_EQ(board_->held(), Vec3{});
}

INSTANTIATE_TEST_SUITE_P(Libraries, HostedLibrary,
                         testing::Values(Case{"forcedimension", Misdeed::exits, "ended its process (code 3)"},
                                         Case{"forcedimension", Misdeed::aborts, "crashed (Aborted)"},
                                         Case{"forcedimension", Misdeed::crashes,
                                              "crashed (Segmentation fault)"},
                                         Case{"forcedimension", Misdeed::hangs, "did not return from a call"},
                                         Case{"touch", Misdeed::exits, "ended its process (code 3)"},
                                         Case{"touch", Misdeed::aborts, "crashed (Aborted)"},
                                         Case{"touch", Misdeed::crashes, "crashed (Segmentation fault)"},
                                         Case{"touch", Misdeed::hangs, "did not return from a call"}),
                         [](const testing::TestParamInfo<Case>& tested) {
                           return std::string(tested.param.scheme) + "_" + name_of(tested.param.what);
                         });

}  // namespace
}  // namespace palpable::device
