// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/ply_header.hpp"

#include "palpable/core/byte_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace palpable::sources {
namespace {

struct PlyElement {
  std::uint64_t count = 0;
  /// At least, in a binary file.
  std::uint64_t bytes = 0;
};

struct PlyHeader {
  bool ascii = false;
  std::vector<PlyElement> elements;
  std::string_view body;
};

std::string_view next_word(std::string_view& line) {
  const auto begin = std::min(line.find_first_not_of(" \t\r"), line.size());
  line.remove_prefix(begin);
  const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
  line.remove_prefix(word.size());
  return word;
}

std::uint64_t bytes_of_type(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, std::uint64_t>, 16> kTypes{{{"char", 1},
                                                                               {"uchar", 1},
                                                                               {"int8", 1},
                                                                               {"uint8", 1},
                                                                               {"short", 2},
                                                                               {"ushort", 2},
                                                                               {"int16", 2},
                                                                               {"uint16", 2},
                                                                               {"int", 4},
                                                                               {"uint", 4},
                                                                               {"int32", 4},
                                                                               {"uint32", 4},
                                                                               {"float", 4},
                                                                               {"float32", 4},
                                                                               {"double", 8},
                                                                               {"float64", 8}}};
  const auto found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == type; });
  return found == kTypes.end() ? 0 : found->second;
}

std::optional<std::uint64_t> count_of(std::string_view word) {
  std::uint64_t count = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (fault != std::errc() || end != word.data() + word.size() || word.empty()) return std::nullopt;
  return count;
}

Result<PlyHeader> header_of(std::string_view text) {
  PlyHeader header;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) break;
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    const std::string_view word = next_word(line);
    if (word == "end_header") {
      header.body = text;
      return header;
    }
    if (word == "format") header.ascii = next_word(line) == "ascii";
    if (word == "element") {
      next_word(line);
      const auto count = count_of(next_word(line));
      if (!count) return invalid_input("states a number of elements that is none");
      header.elements.push_back({*count, 0});
    }
    if (word == "property" && !header.elements.empty()) {
      std::string_view type = next_word(line);
      if (type == "list") type = next_word(line);
      header.elements.back().bytes += bytes_of_type(type);
    }
  }
  return invalid_input("has a header without an end");
}

/// Lines that hold more than white space.
std::uint64_t lines_in(std::string_view body) {
  std::uint64_t lines = 0;
  while (!body.empty()) {
    const std::size_t end = std::min(body.find('\n'), body.size());
    if (body.substr(0, end).find_first_not_of(" \t\r") != std::string_view::npos) ++lines;
    body.remove_prefix(std::min(end + 1, body.size()));
  }
  return lines;
}

}  // namespace

Result<void> check_ply(std::span<const std::byte> file) {
  const auto header = header_of(as_text(file));
  if (!header) return header.error();
  const std::uint64_t there = header->ascii ? lines_in(header->body) : header->body.size();
  std::uint64_t stated = 0;
  for (const PlyElement& element : header->elements) {
    const std::uint64_t each = header->ascii ? 1 : element.bytes;
    // Counts are compared by division: their product may be larger than any number.
    if (each > 0 && element.count > (there - stated) / each)
      return invalid_input("is cut off: it holds less than its header states");
    stated += element.count * each;
  }
  return {};
}

}  // namespace palpable::sources
