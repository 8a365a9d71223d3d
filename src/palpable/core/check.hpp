// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable {

/// Prints the failed condition with its source location to standard error and aborts. Only for bugs of this
/// program, never for input.
[[noreturn]] void check_failed(const char* condition, const char* file, int line);

}  // namespace palpable

/// An assertion that is active in every build. Not for the tick path, which must not stop.
#define PALPABLE_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::palpable::check_failed(#condition, __FILE__, __LINE__))
