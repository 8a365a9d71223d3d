// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/ask_to_hold.hpp"

#include "palpable/core/system/child_process.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

TEST(AskToHold, WaitsForOneLineAndLeavesTheNext) {
  auto pipe = make_pipe();
  ASSERT_TRUE(pipe);
  auto& [read_end, write_end] = *pipe;
  ASSERT_EQ(::write(write_end.number(), "yes\nstart\n", 10), 10);
  wait_for_line(read_end.number());
  char next = 0;
  ASSERT_EQ(::read(read_end.number(), &next, 1), 1);
  EXPECT_EQ(next, 's');
  write_end.close();
  wait_for_line(read_end.number());
  wait_for_line(read_end.number());
}

}  // namespace
}  // namespace palpable::cli
