// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/work.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace palpable {

unsigned Work::thread_count() const {
  return threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
}

void parallel_for(const Work& work, int count, int grain, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  const int wanted = static_cast<int>(std::min(work.thread_count(), 256U));
  const int parts = std::clamp(count / std::max(grain, 1), 1, wanted);
  const auto edge = [&](int part) { return static_cast<int>(static_cast<long long>(count) * part / parts); };
  std::exception_ptr first;
  std::mutex first_mutex;
  const auto run = [&](int part) {
    try {
      body(edge(part), edge(part + 1));
    } catch (...) {
      const std::lock_guard lock(first_mutex);
      if (!first) first = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    helpers.reserve(static_cast<std::size_t>(parts));
    for (int part = 1; part < parts; ++part) helpers.emplace_back(run, part);
    run(0);
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace palpable
