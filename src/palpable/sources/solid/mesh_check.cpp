// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/mesh_check.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/solid/polygon.hpp"
#include "palpable/sources/solid/text_words.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;

/// A file with holes, or whose end the disk never got, has zeros there, which are no text.
Result<void> check_text(std::string_view text, std::string_view kind) {
  const std::size_t zero = text.find('\0');
  if (zero == std::string_view::npos) return {};
  return invalid_input(
      fmt::format("is {} file that is damaged: byte {} is zero, which is no text", kind, zero));
}

Result<void> check_text_stl(std::string_view text) {
  if (auto plain = check_text(text, "an STL"); !plain) return plain;
  std::size_t begun = 0, ended = 0, corners = 0;
  bool is_open = false;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    const std::string_view word = next_word(line);
    begun += word == "facet" ? 1 : 0;
    ended += word == "endfacet" ? 1 : 0;
    corners += word == "vertex" ? 1 : 0;
    if (word == "solid") is_open = true;
    if (word == "endsolid") is_open = false;
  }
  if (is_open || begun != ended || corners != 3 * ended)
    return invalid_input(
        fmt::format("is an STL file that is cut off or damaged: after {} whole triangles its end "
                    "(endsolid) is missing",
                    ended));
  return {};
}

Result<void> check_stl(std::span<const std::byte> file) {
  const std::string_view text = as_text(file);
  const bool is_text =
      text.starts_with("solid") && text.substr(0, 4096).find("facet") != std::string_view::npos;
  if (is_text) return check_text_stl(text);
  const std::size_t stated = stated_stl_bytes(file);
  if (stated == file.size()) return {};
  if (stated == 0) return invalid_input("is an STL file that is cut off in its header");
  return invalid_input(
      fmt::format("is an STL file that is cut off or damaged: it states {} triangles, which take {} "
                  "bytes, and has {}",
                  (stated - kStlHeader) / kStlTriangle, stated, file.size()));
}

/// The vertex index of "7/1/3"; nullopt if it is not a number.
std::optional<long long> face_corner_of(std::string_view word) {
  long long index = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (fault != std::errc{} || (end != word.data() + word.size() && *end != '/')) return std::nullopt;
  return index;
}

class ObjCheck {
 public:
  Result<void> check(std::string_view text) {
    if (auto plain = check_text(text, "an OBJ"); !plain) return plain;
    const bool has_end = text.ends_with('\n');
    while (!text.empty()) {
      std::string_view line = next_line(text);
      ++line_number_;
      // A line with a continuation: the words of both lines.
      std::string joined;
      while (line.ends_with('\\') || line.ends_with("\\\r")) {
        joined += line.substr(0, line.rfind('\\'));
        joined += ' ';
        line = next_line(text);
        ++line_number_;
      }
      if (!joined.empty()) {
        joined += line;
        line = joined;
      }
      const std::string_view word = next_word(line);
      const bool good = word == "v" ? add_vertex(line) : word != "f" || add_face(line);
      if (corners_ > kMostCorners)
        return invalid_input(
            fmt::format("has a face of more than {} corners, in line {}", kMostCorners, line_number_));
      if (!good)
        return invalid_input(
            fmt::format("is an OBJ file that is cut off or damaged: line {} is not a complete {}",
                        line_number_, word == "v" ? "vertex" : "face"));
    }
    if (highest_ > vertices_)
      return invalid_input(
          fmt::format("is an OBJ file that is cut off or damaged: the face in line {} names vertex {} "
                      "of {}",
                      line_of_highest_, highest_, vertices_));
    // A valid file may lack the last line end or contain unused vertices; a truncated file has both.
    constexpr double kMany = 0.01;
    const auto unused = vertices_ - std::count(used_.begin(), used_.end(), true);
    if (!has_end && static_cast<double>(unused) > kMany * static_cast<double>(vertices_))
      return invalid_input(
          fmt::format("is an OBJ file that is cut off: its last line has no end, and {} of its {} "
                      "vertices belong to no face",
                      unused, vertices_));
    return {};
  }

 private:
  bool add_vertex(std::string_view rest) {
    ++vertices_;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = next_word(rest);
      double value = 0.0;
      const char* const first = word.data() + (word.starts_with('+') ? 1 : 0);
      const auto [end, fault] = std::from_chars(first, word.data() + word.size(), value);
      if (word.empty() || fault == std::errc::invalid_argument || end != word.data() + word.size())
        return false;
    }
    return true;
  }
  /// Vertices may follow the faces that use them.
  bool add_face(std::string_view rest) {
    corners_ = 0;
    for (std::string_view word = next_word(rest);
         !word.empty() && word.front() != '#' && corners_ <= kMostCorners; word = next_word(rest)) {
      const auto index = face_corner_of(word);
      if (!index || *index == 0 || -*index > vertices_) return false;
      if (*index > highest_) highest_ = *index, line_of_highest_ = line_number_;
      use(*index > 0 ? *index : vertices_ + 1 + *index);
      ++corners_;
    }
    return corners_ >= 3;
  }

  void use(long long vertex) {
    // Greater than in any supported mesh; a wrong index is reported at the end.
    constexpr long long kMost = 1LL << 28U;
    if (vertex > kMost) return;
    const auto at = static_cast<std::size_t>(vertex) - 1;
    if (at >= used_.size()) used_.resize(std::max(at + 1, 2 * used_.size()));
    used_[at] = true;
  }

  std::vector<bool> used_;
  std::size_t line_number_ = 0;
  /// Of the last face.
  std::size_t corners_ = 0;
  long long vertices_ = 0;
  long long highest_ = 0;
  std::size_t line_of_highest_ = 0;
};

Result<void> check_glb(std::span<const std::byte> file) {
  ByteReader reader(file);
  reader.seek(8);
  const std::size_t stated = reader.u32();
  if (!reader.ok() || stated > file.size())
    return invalid_input(
        fmt::format("is a GLB file that is cut off: it states {} bytes and has {}", stated, file.size()));
  // The stated length is that of the whole file (glTF 2.0, 4.4.2).
  if (stated < file.size())
    return invalid_input(
        fmt::format("is a damaged GLB file: it states {} bytes and has {}", stated, file.size()));
  return {};
}

}  // namespace

std::size_t stated_stl_bytes(std::span<const std::byte> file) {
  ByteReader reader(file);
  reader.seek(80);
  const std::size_t triangles = reader.u32();
  return reader.ok() ? kStlHeader + kStlTriangle * triangles : 0;
}

bool is_named_stl(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".stl";
}

Result<void> check_mesh_file(std::span<const std::byte> file, const std::string& ending) {
  if (ending == "stl") return check_stl(file);
  if (ending == "obj") return ObjCheck().check(as_text(file));
  if (ending == "glb") return check_glb(file);
  return {};
}

}  // namespace palpable::sources
