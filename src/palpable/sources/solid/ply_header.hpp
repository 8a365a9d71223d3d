// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::sources {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

std::size_t bytes_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  /// A list states its length in this type before its values.
  bool is_list = false;
  PlyType length_type = PlyType::u8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  /// Least size of one value of the property in a binary file; for a list, that of its length.
  std::size_t least_bytes() const;
};

struct PlyHeader {
  enum class Format : std::uint8_t { ascii, little_endian, big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  /// The bytes after the header; a view of the file.
  std::span<const std::byte> body;
};

/// Parses the header of a PLY file and checks it against the file's size: each element takes at least the
/// bytes of its properties (binary) or a line (ASCII), so a stated count cannot cause more memory to be
/// allocated than the file justifies. Errors: invalid_input for a damaged header or one without an end, and
/// for a file with less data than its header states.
Result<PlyHeader> parse_ply_header(std::span<const std::byte> file);

/// Removes the first line from `text` and returns it without its line end ("\n" or "\r\n").
std::string_view take_line(std::string_view& text);
/// Removes the first word from `line` and returns it; empty if there is none.
std::string_view take_word(std::string_view& line);

}  // namespace palpable::sources
