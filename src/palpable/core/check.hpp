// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable {

/// Prints the failed condition with its place to standard error and aborts: for our own bugs only, never for
/// input.
[[noreturn]] void check_failed(const char* condition, const char* file, int line);

}  // namespace palpable

/// An assertion that is on in every build. Not for the tick path, which must not be able to stop.
#define PALPABLE_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::palpable::check_failed(#condition, __FILE__, __LINE__))
