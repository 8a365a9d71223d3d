// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace palpable {

/// The 64-bit FNV-1a hash (Fowler, Noll, Vo) of numbers and strings; the same on every machine. Not for
/// security.
class Fnv1a {
 public:
  template <std::unsigned_integral T>
  void add(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      hash_ ^= static_cast<std::uint64_t>(value >> (8 * i) & 0xFFU);
      hash_ *= 0x100000001B3U;
    }
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    for (const char letter : text) add(static_cast<std::uint8_t>(letter));
  }
  std::uint64_t value() const { return hash_; }
  /// The value as sixteen hexadecimal digits.
  std::string digits() const {
    std::string digits(16, '0');
    for (std::size_t i = 0; i < digits.size(); ++i)
      digits[i] = "0123456789abcdef"[hash_ >> (60 - 4 * i) & 0xFU];
    return digits;
  }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

}  // namespace palpable
