// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace palpable {

void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "palpable: this is a bug in palpable: %s does not hold at %s:%d\n", condition, file,
               line);
  std::abort();
}

}  // namespace palpable
