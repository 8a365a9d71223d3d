// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <thread>

namespace palpable {

/// For tests of what another thread or process does in its own time: whether a condition, looked at every
/// `pause`, becomes true within `longest`, which is long so that a busy machine is no fault.
template <class Condition>
bool comes_true(Condition condition, std::chrono::milliseconds longest = std::chrono::seconds(20),
                std::chrono::milliseconds pause = std::chrono::milliseconds(10)) {
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

}  // namespace palpable
