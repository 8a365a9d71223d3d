// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/child_process.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable {
namespace {

int exit_code_of(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(ChildProcess, HasTheGivenDescriptorsAndNoOthers) {
  auto pipe = make_pipe();
  ASSERT_TRUE(pipe);
  auto& [ours, its] = *pipe;
  // The descriptors as listed by the process itself: 3 was passed to it, 4 is the folder that it reads.
  const auto process = start_child("/bin/sh", {"-c", "ls /proc/self/fd >&3"}, std::array{its.number()});
  ASSERT_TRUE(process) << process.error().message;
  its.close();
  std::array<char, 100> text{};
  const auto got = read(ours.number(), text.data(), text.size());
  EXPECT_EQ(std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0))), "0\n1\n2\n3\n4\n");
  EXPECT_EQ(exit_code_of(*process), 0);
}

TEST(ChildProcess, ItsEndIsSeenAtThePipe) {
  auto pipe = make_pipe();
  ASSERT_TRUE(pipe);
  auto& [ours, its] = *pipe;
  const auto process = start_child("/bin/sh", {"-c", "exit 7"}, std::array{its.number()});
  ASSERT_TRUE(process);
  its.close();
  char byte = 0;
  EXPECT_EQ(read(ours.number(), &byte, 1), 0);
  EXPECT_EQ(exit_code_of(*process), 7);
}

TEST(ChildProcess, AProgramThatIsMissingIsAnErrorWithItsReason) {
  const auto process = start_child("/no/such/program", {}, {});
  ASSERT_FALSE(process);
  EXPECT_THAT(process.error().message, testing::HasSubstr("No such file"));
}

TEST(ChildProcess, AHelperProgramIsNamedByTheEnvironmentOrItsPlacesAreListed) {
  setenv("PALPABLE_TEST_HELPER", "/opt/helper", 1);
  EXPECT_EQ(helper_program("no-such-helper", "PALPABLE_TEST_HELPER", "/opt").value(), "/opt/helper");
  unsetenv("PALPABLE_TEST_HELPER");
  const auto missing = helper_program("no-such-helper", "PALPABLE_TEST_HELPER", "/opt");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, testing::HasSubstr("/opt/no-such-helper"));
  EXPECT_THAT(missing.error().message, testing::HasSubstr("PALPABLE_TEST_HELPER"));
}

TEST(ChildProcess, AHelperProgramThatMayNotBeExecutedIsNamed) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "palpable-helpers";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "no-such-helper") << "#!/bin/sh\n";
  const auto forbidden = helper_program("no-such-helper", "PALPABLE_TEST_HELPER", folder);
  std::filesystem::remove_all(folder);
  ASSERT_FALSE(forbidden);
  EXPECT_THAT(forbidden.error().message, testing::HasSubstr("no-such-helper may not be executed"));
}

}  // namespace
}  // namespace palpable
