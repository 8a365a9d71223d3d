// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// core/work.cpp for a page, which has one thread.
#include "palpable/core/work.hpp"

namespace palpable {

unsigned Work::thread_count() const { return 1; }

void parallel_for(const Work& /*work*/, int count, int /*grain*/,
                  const std::function<void(int begin, int end)>& body) {
  if (count > 0) body(0, count);
}

}  // namespace palpable
