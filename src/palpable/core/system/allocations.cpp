// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/allocations.hpp"

namespace palpable {
namespace {
// Constant-initialised, since malloc is called before any constructor runs.
constinit thread_local std::uint64_t allocated_here = 0;
constinit bool linked = false;
}  // namespace

std::uint64_t allocations_of_this_thread() noexcept { return allocated_here; }
bool allocations_are_counted() noexcept { return linked; }

namespace allocation_counter {
void note() noexcept { ++allocated_here; }
void declare_linked() noexcept { linked = true; }
}  // namespace allocation_counter

}  // namespace palpable
