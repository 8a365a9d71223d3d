// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/byte_writer.hpp"
#include "palpable/core/vec3.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace palpable::onefile {

// A value is written and read by one function, so that both agree:
//   template <class Archive>
//   void fields(Archive& archive, typename Archive::template Ref<Type> value) { archive(value.a, value.b); }
// Numbers are little-endian; a text or list begins with its count.

/// Appends values to bytes.
class ByteOutput {
 public:
  template <class T>
  using Ref = const T&;

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  /// An enumeration with `count` values, 0 and up.
  template <class Enum>
  void choice(Enum value, unsigned /*count*/) {
    out_.u8(static_cast<std::uint8_t>(value));
  }
  void block(std::span<const std::byte> bytes) {
    count(bytes.size());
    out_.text(as_text(bytes));
  }
  std::span<const std::byte> bytes() const { return out_.bytes(); }

 private:
  void put(bool value) { out_.u8(value ? 1 : 0); }
  void put(int value) { out_.u32(static_cast<std::uint32_t>(value)); }
  void put(double value) { out_.f64(value); }
  void put(const Vec3& value) { (*this)(value.x, value.y, value.z); }
  void put(const std::string& text) { block(palpable::as_bytes(text)); }
  template <class T>
  void put(const std::vector<T>& values) {
    count(values.size());
    for (const T& value : values) put(value);
  }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& values) {
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const T& value) {
    fields(*this, value);
  }
  void count(std::size_t count) { out_.u32(static_cast<std::uint32_t>(count)); }

  ByteWriter out_;
};

/// Reads what ByteOutput has written. A text, list or choice that cannot be is refused: ok() becomes false
/// permanently, and all further values are empty. Takes no more memory than the bytes can fill.
class ByteInput {
 public:
  template <class T>
  using Ref = T&;

  explicit ByteInput(std::span<const std::byte> bytes) : in_(bytes) {}

  bool ok() const { return ok_ && in_.ok(); }
  bool at_end() const { return in_.left() == 0; }

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  template <class Enum>
  void choice(Enum& value, unsigned count) {
    const std::uint8_t number = in_.u8();
    ok_ = ok_ && number < count;
    value = static_cast<Enum>(ok_ ? number : 0);
  }
  std::span<const std::byte> block() { return in_.bytes(count(1)); }

 private:
  void get(bool& value) { choice(value, 2); }
  void get(int& value) { value = static_cast<int>(in_.u32()); }
  void get(double& value) { value = in_.f64(); }
  void get(Vec3& value) { (*this)(value.x, value.y, value.z); }
  void get(std::string& text) { text = as_text(block()); }
  template <class T>
  void get(std::vector<T>& values) {
    const std::size_t size = count(1);
    values.clear();
    for (std::size_t i = 0; i < size && ok(); ++i) get(values.emplace_back());
  }
  template <class T, std::size_t n>
  void get(std::array<T, n>& values) {
    for (T& value : values) get(value);
  }
  template <class T>
  void get(T& value) {
    fields(*this, value);
  }
  /// A count of values of at least `each` bytes.
  std::size_t count(std::size_t each) {
    const std::size_t count = in_.u32();
    if (count > in_.left() / each) ok_ = false;
    return ok_ ? count : 0;
  }

  ByteReader in_;
  bool ok_ = true;
};

}  // namespace palpable::onefile
