// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable {

/// Number of heap allocations that the calling thread has made since it started: malloc, calloc, realloc and
/// everything built on them, operator new included, in this project's code and in all libraries. Counted only
/// in programs that link the object library palpable_allocation_counter; 0 elsewhere. Never allocates; any
/// thread.
std::uint64_t allocations_of_this_thread() noexcept;

/// Whether this program counts allocations (see above). Tests check this first, so that a guard without the
/// counter cannot pass.
bool allocations_are_counted() noexcept;

/// Counts the calling thread's allocations since the scope began.
///   AllocationScope scope; law.feel(hand, state); EXPECT_EQ(scope.count(), 0U);
class AllocationScope {
 public:
  AllocationScope() noexcept : begin_(allocations_of_this_thread()) {}
  std::uint64_t count() const noexcept { return allocations_of_this_thread() - begin_; }

 private:
  std::uint64_t begin_;
};

/// Only for palpable_allocation_counter.
namespace allocation_counter {
void note() noexcept;
void declare_linked() noexcept;
}  // namespace allocation_counter

}  // namespace palpable
