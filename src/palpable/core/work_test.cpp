// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/work.hpp"

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

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

TEST(ParallelFor, HasNoPartSmallerThanTheGrain) {
  Work work;
  work.threads = 8;
  std::atomic<int> parts{0};
  parallel_for(work, 100, 40, [&](int begin, int end) {
    EXPECT_GE(end - begin, 40);
    ++parts;
  });
  EXPECT_EQ(parts.load(), 2);
  parallel_for(work, 0, 40, [](int, int) { FAIL() << "there is nothing to do"; });
}

TEST(ParallelFor, DividesTheSameWayEveryTime) {
  Work work;
  work.threads = 3;
  const auto edges = [&] {
    std::mutex guard;
    std::set<std::pair<int, int>> found;
    parallel_for(work, 1000, 1, [&](int begin, int end) {
      const std::lock_guard lock(guard);
      found.insert({begin, end});
    });
    return found;
  };
  const auto first = edges();
  EXPECT_EQ(first.size(), 3U);
  EXPECT_EQ(edges(), first);
}

TEST(Work, IsCancelledByItsFlag) {
  std::atomic<bool> cancel{false};
  Work work;
  EXPECT_FALSE(work.cancelled());
  work.cancel = &cancel;
  EXPECT_FALSE(work.cancelled());
  cancel = true;
  EXPECT_TRUE(work.cancelled());
  EXPECT_EQ(Work::interrupted().code, ErrorCode::interrupted);
}

TEST(Work, ReportsProgressToItsCallback) {
  Work work;
  work.report(0.5, "nobody listens");
  std::string heard;
  work.progress = [&](double fraction, std::string_view what) {
    heard = std::to_string(fraction) + " " + std::string(what);
  };
  work.report(0.25, "matching");
  EXPECT_EQ(heard, "0.250000 matching");
}

}  // namespace
}  // namespace palpable
