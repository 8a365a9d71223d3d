// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/zero_force.hpp"

#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/haptics/servo/test_touch.hpp"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::haptics {
namespace {

/// A hand held 2 mm below a surface. Prints to standard error that the servo was stopped, if there was a
/// force before and the last force was zero.
class ReportingDevice final : public device::Device {
 public:
  ReportingDevice() {
    traits_.name = "reporting";
    reading_.position.v = {0.0, 0.0, -0.002};
  }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    if (crash_when_pushed && pushed) std::abort();
    return reading_;
  }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    last_N = norm(force_N);
    if (last_N > 0.5 && !pushed.exchange(true)) pushed.notify_all();
  }
  void stop() noexcept override {
    constexpr char kText[] = "zero force\n";
    if (pushed && last_N == 0.0) static_cast<void>(!write_text(kText, sizeof kText - 1));
    ++stops;
  }

  std::atomic<bool> pushed{false};
  std::atomic<double> last_N{0.0};
  std::atomic<int> stops{0};
  bool crash_when_pushed = false;

 private:
  static bool write_text(const char* text, std::size_t size) {
    return ::write(STDERR_FILENO, text, size) == static_cast<ssize_t>(size);
  }
  device::Traits traits_;
  device::Reading reading_;
};

struct Wall {
  explicit Wall(bool crash = false) {
    auto owned = std::make_unique<ReportingDevice>();
    owned->crash_when_pushed = crash;
    device = owned.get();
    ServoOptions options;
    options.memory = Memory::leave;
    HapticScene program{std::make_shared<SpringSurface>(flat, 500.0, 0.5), {}, 1};
    loop = *ServoLoop::start(std::move(owned), std::move(program), options);
  }
  /// The force rises within a quarter of a second.
  bool comes_to_push() const {
    device->pushed.wait(false);
    return device->pushed;
  }
  ReportingDevice* device = nullptr;
  std::unique_ptr<ServoLoop> loop;
};

TEST(ZeroForce, IsWrittenByEveryServoThatIsEndedFromOutside) {
  Wall first;
  Wall second;
  ASSERT_TRUE(first.comes_to_push() && second.comes_to_push());
  EXPECT_TRUE(end_every_servo(10000));
  for (const Wall* wall : {&first, &second}) {
    EXPECT_EQ(wall->device->last_N, 0.0);
    EXPECT_GE(wall->device->stops, 1);
  }
  Wall later;
  EXPECT_TRUE(later.comes_to_push()) << "a servo that begins afterwards runs";
}

// The child of a death test starts from the beginning, so its threads are its own.
class ZeroForceDeathTest : public testing::Test {
 protected:
  void SetUp() override { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

TEST_F(ZeroForceDeathTest, IsWrittenWhenAnotherThreadCrashes) {
  EXPECT_EXIT(
      {
        write_zero_force_on_crash();
        const Wall wall;
        if (wall.comes_to_push()) std::abort();
      },
      testing::KilledBySignal(SIGABRT), "zero force");
}

TEST_F(ZeroForceDeathTest, IsWrittenWhenTheServoItselfCrashes) {
  EXPECT_EXIT(
      {
        write_zero_force_on_crash();
        const Wall wall(true);
        pause();  // Until the signal comes.
      },
      testing::KilledBySignal(SIGABRT), "zero force");
}

TEST_F(ZeroForceDeathTest, IsWrittenBeforeEverySignalThatEndsTheProgram) {
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP, SIGQUIT, SIGXCPU,
                           SIGXFSZ, SIGPIPE, SIGUSR1, SIGUSR2, SIGALRM})
    EXPECT_EXIT(
        {
          write_zero_force_on_crash();
          const Wall wall;
          // The signal is sent to the process: any thread may receive it, also the servo thread.
          if (wall.comes_to_push()) kill(getpid(), number);
          pause();  // Until the signal comes.
        },
        testing::KilledBySignal(number), "zero force")
        << number;
}

TEST_F(ZeroForceDeathTest, IsWrittenWhenAnExceptionIsNotCaught) {
  EXPECT_EXIT(
      {
        write_zero_force_on_crash();
        const Wall wall;
        if (wall.comes_to_push()) std::thread([] { throw std::runtime_error("nobody catches this"); }).join();
      },
      testing::KilledBySignal(SIGABRT), "zero force");
}

TEST_F(ZeroForceDeathTest, IgnoresTheStopSignalOfATerminal) {
  EXPECT_EXIT(
      {
        write_zero_force_on_crash();
        kill(getpid(), SIGTSTP);
        std::_Exit(0);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace palpable::haptics
