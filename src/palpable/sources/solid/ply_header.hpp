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
  /// The least that one of them takes in a binary file: a list at least its length.
  std::size_t least_bytes() const;
};

struct PlyHeader {
  enum class Format : std::uint8_t { ascii, little_endian, big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  /// What follows the header, in the file's own memory.
  std::span<const std::byte> body;
};

/// The header of a PLY file, checked against the file's size: each element takes at least the bytes of its
/// properties (binary) or a line (ASCII), so that no stated count takes memory that the rest of the file does
/// not explain. Errors: invalid_input for a header that is damaged or has no end, and for a file that holds
/// less than its header states.
Result<PlyHeader> parse_ply_header(std::span<const std::byte> file);

/// Cuts `text` after its first line and returns that line without its end ("\n" or "\r\n").
std::string_view take_line(std::string_view& text);
/// Cuts `line` after its first word and returns that word; empty where there is none.
std::string_view take_word(std::string_view& line);

}  // namespace palpable::sources
