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

// The layout of what the decoder process gives back: numbers and arrays as they lie in memory, one behind the
// other. Both processes are of one build, so there is no byte order to agree on.
namespace palpable::sources::isolated {

class FlatWriter {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { put_array(std::span(&value, 1)); }
  /// Without its length.
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

/// Reads what FlatWriter wrote, from a process that may have been taken over: past the end it gives zeros and
/// nothing, and ok() becomes false for good. What the values mean is the caller's to check.
class FlatReader {
 public:
  explicit FlatReader(std::span<const std::byte> bytes) : left_(bytes) {}

  bool ok() const { return ok_; }
  /// Everything was read, and nothing was missing.
  bool done() const { return ok_ && left_.empty(); }

  template <class T>
  requires std::is_trivially_copyable_v<T> T get() {
    T value{};
    const auto raw = take(sizeof(T));
    if (!raw.empty()) std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }
  /// `count` values; none where fewer are left, and no memory is taken for them.
  template <class T>
  requires std::is_trivially_copyable_v<T> std::vector<T> get_array(std::uint64_t count) {
    std::vector<T> values;
    const auto raw =
        count <= left_.size() / sizeof(T) ? take(static_cast<std::size_t>(count) * sizeof(T)) : fail();
    values.resize(raw.size() / sizeof(T));
    if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
    return values;
  }
  /// `count` bytes as they lie in the reply.
  std::span<const std::byte> get_bytes(std::uint64_t count) {
    return count <= left_.size() ? take(static_cast<std::size_t>(count)) : fail();
  }
  /// Text for a person: cut to `longest` bytes, control characters replaced.
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

/// The error for a reply that is not what the job gives.
Error invalid_reply();

/// A reply that is an error, and back: an error's code is always invalid_input.
std::vector<std::byte> error_reply(const Error& error);
/// The beginning of a reply that is a value; its content follows.
void begin_value(FlatWriter& reply);
/// Goes to the content of a value. Errors: the one that the reply holds.
Result<void> open_reply(FlatReader& reply);

}  // namespace palpable::sources::isolated
