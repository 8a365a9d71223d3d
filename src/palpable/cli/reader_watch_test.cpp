// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/reader_watch.hpp"

#include <array>
#include <csignal>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

std::array<int, 2> new_pipe() {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe(ends.data()), 0);
  return ends;
}

TEST(ReaderWatchDeathTest, EndsTheProgramAsSigtermDoesWhenNobodyReads) {
  EXPECT_EXIT(
      {
        const auto ends = new_pipe();
        const ReaderWatch watch(ends[1]);
        close(ends[0]);
        alarm(60);
        while (true) pause();
      },
      testing::KilledBySignal(SIGTERM), "");
}

TEST(ReaderWatch, EndsItselfWhileThePipeIsRead) {
  const auto ends = new_pipe();
  {
    const ReaderWatch watch(ends[1]);
    EXPECT_TRUE(watch.watches());
  }
  EXPECT_EQ(write(ends[1], "a", 1), 1) << "the pipe is still open";
  close(ends[0]);
  close(ends[1]);
}

TEST(ReaderWatch, WatchesNeitherNoDescriptorNorAFile) {
  EXPECT_FALSE(ReaderWatch(-1).watches());
  EXPECT_FALSE(ReaderWatch(1023).watches()) << "closed";
  const int file = open("/dev/null", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(file, 0);
  EXPECT_FALSE(ReaderWatch(file).watches());
  close(file);
}

}  // namespace
}  // namespace palpable::cli
