// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/reader_watch.hpp"

#include <array>
#include <csignal>

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
  { const ReaderWatch watch(ends[1]); }
  EXPECT_EQ(write(ends[1], "a", 1), 1);
  close(ends[0]);
  close(ends[1]);
}

TEST(ReaderWatch, WatchesNeitherNoDescriptorNorAFile) {
  { const ReaderWatch none(-1); }
  { const ReaderWatch closed(1023); }
  const int file = STDERR_FILENO;
  { const ReaderWatch other(file); }
}

}  // namespace
}  // namespace palpable::cli
