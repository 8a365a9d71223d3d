// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// The binary layout of the decoder process's replies: numbers and arrays as in memory, one after another.
// Both processes are from the same build, so the byte order is the same.
namespace palpable::sources::isolated {

class FlatWriter {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { put_array(std::span(&value, 1)); }
  /// Writes the elements without their number.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put_array(std::span<const T> values) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + values.size_bytes());
    if (!values.empty()) std::memcpy(bytes_.data() + at, values.data(), values.size_bytes());
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    put_array(std::span(text.data(), text.size()));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads the output of FlatWriter from a process that may be compromised. A read past the end gives zeros and
/// empty arrays and sets ok() to false permanently. The caller must check the values.
class FlatReader {
 public:
  explicit FlatReader(std::span<const std::byte> bytes) : left_(bytes) {}

  bool ok() const { return ok_; }
  /// Whether everything was read and nothing was missing.
  bool done() const { return ok_ && left_.empty(); }

  template <class T>
  requires std::is_trivially_copyable_v<T> T get() {
    T value{};
    const auto raw = take(sizeof(T));
    if (!raw.empty()) std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }
  /// Reads `count` values; an empty vector if fewer are left; then no memory is allocated.
  template <class T>
  requires std::is_trivially_copyable_v<T> std::vector<T> get_array(std::uint64_t count) {
    std::vector<T> values;
    const auto raw =
        count <= left_.size() / sizeof(T) ? take(static_cast<std::size_t>(count) * sizeof(T)) : fail();
    values.resize(raw.size() / sizeof(T));
    if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
    return values;
  }
  /// A view of the next `count` bytes of the reply.
  std::span<const std::byte> get_bytes(std::uint64_t count) {
    return count <= left_.size() ? take(static_cast<std::size_t>(count)) : fail();
  }
  /// Reads text for display: truncated to `longest` bytes, control characters replaced.
  std::string get_text(std::size_t longest);

 private:
  std::span<const std::byte> take(std::size_t count) {
    if (count > left_.size()) return fail();
    const auto raw = left_.first(count);
    left_ = left_.subspan(count);
    return raw;
  }
  std::span<const std::byte> fail() {
    ok_ = false;
    left_ = {};
    return {};
  }

  std::span<const std::byte> left_;
  bool ok_ = true;
};

/// The error for an invalid reply.
Error invalid_reply();

/// Encodes an error as a reply; the code of a decoded error is always invalid_input.
std::vector<std::byte> error_reply(const Error& error);
/// Writes the start of a reply with a value; its content follows.
void begin_value(FlatWriter& reply);
/// Moves to the content of a value. Errors: the one in the reply.
Result<void> open_reply(FlatReader& reply);

}  // namespace palpable::sources::isolated
