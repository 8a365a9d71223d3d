// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/allocations.hpp"

#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(AllocationScope, CountsNewMallocAndAlignedMemory) {
  ASSERT_TRUE(allocations_are_counted());
  const AllocationScope scope;
  const auto number = std::make_unique<int>(1);
  EXPECT_EQ(scope.count(), 1U);
  // A volatile pointer, since the compiler would otherwise remove the pair.
  void* volatile memory = std::malloc(100);
  std::free(memory);
  EXPECT_EQ(scope.count(), 2U);
#ifndef __SANITIZE_THREAD__  // its hook does not report aligned memory
  memory = std::aligned_alloc(64, 128);
  std::free(memory);
  EXPECT_EQ(scope.count(), 3U);
#endif
}

TEST(AllocationScope, CountsWhatALibraryAllocates) {
  const AllocationScope scope;
  const std::string text = std::to_string(1e300);
  EXPECT_GE(scope.count(), 1U);
}

TEST(AllocationScope, SeesItsOwnThreadOnly) {
  std::uint64_t there = 0;
  const auto allocate = [&] {
    const AllocationScope scope;
    for (int i = 0; i < 10; ++i) std::free(std::malloc(static_cast<std::size_t>(100 + i)));
    void* volatile memory = std::malloc(100);
    std::free(memory);
    there = scope.count();
  };
  std::thread thread(allocate);
  const AllocationScope here;
  thread.join();
  EXPECT_GE(there, 1U);
  EXPECT_EQ(here.count(), 0U);
}

}  // namespace
}  // namespace palpable
