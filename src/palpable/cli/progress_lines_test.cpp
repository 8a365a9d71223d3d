// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/progress_lines.hpp"

#include <array>
#include <csignal>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

TEST(ProgressLines, WritesOneObjectOfJsonALineAndNotMoreThanTenStepsASecond) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ProgressLines lines(ends[1]);
  for (int k = 0; k < 1000; ++k) EXPECT_TRUE(lines.progress(0.5, "Mat\nching"));
  lines.note("a \"note\"");
  lines.error("an error");
  close(ends[1]);
  std::string text(65536, '\0');
  const ssize_t bytes = read(ends[0], text.data(), text.size());
  ASSERT_GT(bytes, 0);
  text.resize(static_cast<std::size_t>(bytes));
  close(ends[0]);
  EXPECT_TRUE(text.starts_with("{\"progress\":0.5,\"step\":\"Mat\\nching\"}\n")) << text;
  EXPECT_TRUE(text.ends_with("{\"note\":\"a \\\"note\\\"\"}\n{\"error\":\"an error\"}\n")) << text;
  EXPECT_LT(text.size(), 2000U);
}

TEST(ProgressLines, SaysThatNobodyReads) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  signal(SIGPIPE, SIG_IGN);
  ProgressLines lines(ends[1]);
  close(ends[0]);
  EXPECT_FALSE(lines.progress(0.5, "Matching"));
  close(ends[1]);
  EXPECT_TRUE(ProgressLines(-1).progress(0.5, "Matching")) << "nobody asked";
}

TEST(ProgressLines, DoNotWaitForAReaderThatDoesNotRead) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ProgressLines lines(ends[1]);
  // A pipe takes 64 KiB; this would wait for ever.
  for (int k = 0; k < 2000; ++k) lines.note(std::string(100, 'a'));
  EXPECT_TRUE(lines.progress(0.5, "Matching")) << "a full pipe is read later";
  close(ends[0]);
  close(ends[1]);
}

TEST(ProgressLines, KnowADescriptorThatTakesNothing) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  EXPECT_TRUE(ProgressLines::can_write_to(-1));
  EXPECT_TRUE(ProgressLines::can_write_to(ends[1]));
  EXPECT_FALSE(ProgressLines::can_write_to(ends[0]));
  close(ends[0]);
  close(ends[1]);
  EXPECT_FALSE(ProgressLines::can_write_to(ends[1]));
}

}  // namespace
}  // namespace palpable::cli
