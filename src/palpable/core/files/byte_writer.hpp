// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace palpable {

/// Appends numbers to a byte vector in little-endian order, for ByteReader.
class ByteWriter {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(std::byte{value}); }
  void u16(std::uint16_t value) { number(value); }
  void u32(std::uint32_t value) { number(value); }
  void u64(std::uint64_t value) { number(value); }
  void f64(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void text(std::string_view value) {
    // One by one: g++ 12 at -O3 falsely warns of an overflow if a range is inserted after numbers.
    for (const char c : value) u8(static_cast<std::uint8_t>(c));
  }

  std::span<const std::byte> bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  template <std::unsigned_integral T>
  void number(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bytes_.push_back(static_cast<std::byte>(value >> (8 * i) & 0xFFU));
  }

  std::vector<std::byte> bytes_;
};

}  // namespace palpable
