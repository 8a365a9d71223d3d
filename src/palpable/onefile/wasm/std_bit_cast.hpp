// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Included before every source: the standard library of emscripten 3.1 has no std::bit_cast yet. The sources
// are the program's, so the name is the standard's.
#include <bit>

#ifndef __cpp_lib_bit_cast
namespace std {
template <class To, class From>
constexpr To bit_cast(const From& value) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, value);
}
}  // namespace std
#endif
