// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace palpable {

/// Reads numbers from untrusted bytes. A read past the end gives zeros and sets ok() to false permanently, so
/// a parser may check once, at its end. Never allocates or throws.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes, std::endian order = std::endian::little)
      : bytes_(bytes), order_(order) {}

  bool ok() const { return ok_; }
  std::endian order() const { return order_; }
  std::size_t position() const { return position_; }
  std::size_t left() const { return bytes_.size() - position_; }
  /// Sets the position, counted from the start.
  void seek(std::size_t position) {
    if (position > bytes_.size()) ok_ = false;
    position_ = std::min(position, bytes_.size());
  }
  void skip(std::size_t count) { bytes(count); }

  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  float f32() { return std::bit_cast<float>(number<std::uint32_t>()); }
  double f64() { return std::bit_cast<double>(number<std::uint64_t>()); }
  /// The next `count` bytes. If fewer are left: an empty span, and ok() becomes false.
  std::span<const std::byte> bytes(std::size_t count) {
    if (count > left()) {
      ok_ = false;
      position_ = bytes_.size();
      return {};
    }
    position_ += count;
    return bytes_.subspan(position_ - count, count);
  }

  template <std::unsigned_integral T>
  T number() {
    const auto raw = bytes(sizeof(T));
    T value = 0;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const std::size_t place = order_ == std::endian::little ? i : raw.size() - 1 - i;
      value = static_cast<T>(value | static_cast<T>(std::to_integer<T>(raw[i]) << (8 * place)));
    }
    return value;
  }

 private:
  std::span<const std::byte> bytes_;
  std::endian order_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

/// Views bytes as text and text as bytes, without copying.
inline std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
inline std::span<const std::byte> as_bytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// True if `bytes` contains `magic` at `offset`.
inline bool has_magic(std::span<const std::byte> bytes, std::string_view magic, std::size_t offset = 0) {
  return as_text(bytes).substr(std::min(offset, bytes.size())).starts_with(magic);
}

}  // namespace palpable
