// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/work.hpp"

#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(ParallelFor, VisitsEveryItemExactlyOnce) {
  for (const unsigned threads : {1U, 2U, 7U}) {
    Work work;
    work.threads = threads;
    std::vector<std::atomic<int>> visits(1003);
    parallel_for(work, 1003, 10, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
    });
    for (const auto& v : visits) ASSERT_EQ(v.load(), 1);
  }
}

TEST(ParallelFor, RethrowsTheFirstException) {
  const Work work;
  EXPECT_THROW(parallel_for(work, 100, 1, [](int, int) { throw std::runtime_error("x"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace palpable
