// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/ply_header.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

namespace palpable::sources {
namespace {

std::optional<PlyType> type_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", PlyType::i8},
                                                                         {"int8", PlyType::i8},
                                                                         {"uchar", PlyType::u8},
                                                                         {"uint8", PlyType::u8},
                                                                         {"short", PlyType::i16},
                                                                         {"int16", PlyType::i16},
                                                                         {"ushort", PlyType::u16},
                                                                         {"uint16", PlyType::u16},
                                                                         {"int", PlyType::i32},
                                                                         {"int32", PlyType::i32},
                                                                         {"uint", PlyType::u32},
                                                                         {"uint32", PlyType::u32},
                                                                         {"float", PlyType::f32},
                                                                         {"float32", PlyType::f32},
                                                                         {"double", PlyType::f64},
                                                                         {"float64", PlyType::f64}}};
  const auto found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == name; });
  if (found == kTypes.end()) return std::nullopt;
  return found->second;
}

std::optional<std::uint64_t> whole_number(std::string_view word) {
  std::uint64_t count = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (fault != std::errc() || end != word.data() + word.size() || word.empty()) return std::nullopt;
  return count;
}

Error damaged_header() { return invalid_input("has a PLY header that is damaged"); }

Result<PlyHeader::Format> format_named(std::string_view name) {
  if (name == "ascii") return PlyHeader::Format::ascii;
  if (name == "binary_little_endian") return PlyHeader::Format::little_endian;
  if (name == "binary_big_endian") return PlyHeader::Format::big_endian;
  return damaged_header();
}

Result<PlyProperty> property_in(std::string_view line) {
  PlyProperty property;
  std::string_view type = take_word(line);
  if (type == "list") {
    const auto length = type_named(take_word(line));
    if (!length || *length == PlyType::f32 || *length == PlyType::f64) return damaged_header();
    property.is_list = true;
    property.length_type = *length;
    type = take_word(line);
  }
  const auto known = type_named(type);
  property.name = take_word(line);
  if (!known || property.name.empty()) return damaged_header();
  property.type = *known;
  return property;
}

Result<PlyHeader> header_in(std::string_view text) {
  // Greater than in any real file; bounds the parsing of random data.
  constexpr std::size_t kMostElements = 64, kMostProperties = 256;
  PlyHeader header;
  bool has_format = false;
  if (take_line(text) != "ply") return damaged_header();
  while (!text.empty()) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word == "end_header") {
      header.body = as_bytes(text);
      if (!has_format) return damaged_header();
      return header;
    }
    if (word == "format") {
      const auto format = format_named(take_word(line));
      if (!format || has_format) return damaged_header();
      header.format = *format;
      has_format = true;
    } else if (word == "element") {
      PlyElement element;
      element.name = take_word(line);
      const auto count = whole_number(take_word(line));
      if (!count || header.elements.size() == kMostElements) return damaged_header();
      element.count = *count;
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      auto property = property_in(line);
      if (!property) return property.error();
      if (header.elements.empty() || header.elements.back().properties.size() == kMostProperties)
        return damaged_header();
      header.elements.back().properties.push_back(*std::move(property));
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
      return damaged_header();
    }
  }
  return invalid_input("has a header without an end");
}

/// Number of lines that are not blank.
std::uint64_t lines_in(std::string_view body) {
  std::uint64_t lines = 0;
  while (!body.empty()) {
    std::string_view line = take_line(body);
    if (!take_word(line).empty()) ++lines;
  }
  return lines;
}

}  // namespace

std::size_t bytes_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::least_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += bytes_of(p.is_list ? p.length_type : p.type);
  return bytes;
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

Result<PlyHeader> parse_ply_header(std::span<const std::byte> file) {
  auto header = header_in(as_text(file));
  if (!header) return header;
  const bool ascii = header->format == PlyHeader::Format::ascii;
  const std::uint64_t there = ascii ? lines_in(as_text(header->body)) : header->body.size();
  std::uint64_t stated = 0;
  for (const PlyElement& element : header->elements) {
    const std::uint64_t each = ascii ? 1 : element.least_bytes();
    if (each == 0 && element.count > 0) return damaged_header();
    // Compared by division, since the product may overflow.
    if (each > 0 && element.count > (there - stated) / each)
      return invalid_input("is cut off: it holds less than its header states");
    stated += element.count * each;
  }
  return header;
}

}  // namespace palpable::sources
