// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/guardian.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/device/simulated/motor_file.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::haptics {
namespace {

class GuardianTest : public testing::Test {
 protected:
  void SetUp() override { motors = *device::MotorFile::create(file); }
  void TearDown() override { std::filesystem::remove(file); }
  bool all_zero() const {
    const auto bytes = read_file(file);
    return bytes && !bytes->empty() &&
           std::all_of(bytes->begin(), bytes->end(), [](std::byte byte) { return byte == std::byte{0}; });
  }
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("guardian-" + std::to_string(getpid()));
  std::unique_ptr<device::MotorFile> motors;
};

TEST_F(GuardianTest, DoesNotChangeTheForceWhileItsProgramRuns) {
  const auto guardian = Guardian::start(motors->zero_write());
  ASSERT_TRUE(guardian) << guardian.error().message;
  motors->write({0.0, 0.0, 2.0});
  EXPECT_FALSE(all_zero());
}

TEST_F(GuardianTest, WritesZeroWhenItsProgramIsKilled) {
  // The guardian of a program that has ended becomes a child of this process.
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t program = fork();
  ASSERT_GE(program, 0);
  if (program == 0) {
    auto guardian = Guardian::start(motors->zero_write());
    if (!guardian) _exit(1);
    motors->write({0.0, 0.0, 2.0});
    std::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(program, &status, 0), program);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_GT(wait(&status), 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(all_zero());
}

TEST_F(GuardianTest, WritesZeroWhileTheServoStandsStillAndNotBeforeItsFirstTick) {
  const auto guardian = Guardian::start(motors->zero_write());
  ASSERT_TRUE(guardian) << guardian.error().message;
  motors->write({0.0, 0.0, 2.0});
  const auto until = [](auto reached) {
    while (!reached()) std::this_thread::yield();
  };
  for (int time = 0; time < 3; ++time) {
    motors->write({0.0, 0.0, 2.0});
    EXPECT_FALSE(all_zero());
    (*guardian)->beat();
    until([&] { return all_zero(); });
  }
}

TEST_F(GuardianTest, WritesZeroAndEndsWithItsOwner) {
  auto guardian = Guardian::start(motors->zero_write());
  ASSERT_TRUE(guardian) << guardian.error().message;
  const pid_t process = (*guardian)->process();
  motors->write({1.0, 0.0, 0.0});
  guardian->reset();
  EXPECT_TRUE(all_zero());
  EXPECT_NE(kill(process, 0), 0);
}

TEST_F(GuardianTest, IsStartedAgainAfterItWasKilled) {
  const auto guardian = Guardian::start(motors->zero_write());
  ASSERT_TRUE(guardian) << guardian.error().message;
  ASSERT_TRUE((*guardian)->keep_alive());
  const pid_t first = (*guardian)->process();
  kill(first, SIGKILL);
  siginfo_t ended{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(first), &ended, WEXITED | WNOWAIT), 0);
  ASSERT_TRUE((*guardian)->keep_alive());
  EXPECT_NE((*guardian)->process(), first);
  motors->write({0.0, 0.0, 2.0});
  (*guardian)->beat();
  while (!all_zero()) std::this_thread::yield();
}

TEST_F(GuardianTest, IsAnErrorWithItsNameWhereItsProgramIsMissingOrAnother) {
  const std::string hangs = file.string() + ".sh";
  std::ofstream(hangs) << "#!/bin/sh\nexec sleep 60\n";
  std::filesystem::permissions(hangs, std::filesystem::perms::owner_all);
  for (const std::string& wrong :
       {std::string("/no/such/guardian"), std::string("/tmp"), std::string("/bin/true"), hangs}) {
    setenv("PALPABLE_GUARDIAN", wrong.c_str(), 1);
    const auto guardian = Guardian::start(motors->zero_write());
    unsetenv("PALPABLE_GUARDIAN");
    ASSERT_FALSE(guardian) << wrong;
    EXPECT_NE(guardian.error().message.find(wrong), std::string::npos) << guardian.error().message;
  }
  std::filesystem::remove(hangs);
}

}  // namespace
}  // namespace palpable::haptics
