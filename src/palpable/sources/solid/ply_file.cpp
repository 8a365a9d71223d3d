// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/ply_file.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/solid/ply_header.hpp"
#include "palpable/sources/solid/polygon.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace palpable::sources {
namespace {

constexpr std::size_t kMostPoints = 50'000'000;

Error too_short() { return invalid_input("is cut off: it holds less than its header states"); }
Error too_long() { return invalid_input("is damaged: it holds more than its header states"); }

/// Reads values sequentially, in any of the formats. Errors are kept for ok().
class PlyBody {
 public:
  explicit PlyBody(const PlyHeader& header)
      : ascii_(header.format == PlyHeader::Format::ascii),
        text_(as_text(header.body)),
        binary_(header.body,
                header.format == PlyHeader::Format::big_endian ? std::endian::big : std::endian::little) {}

  /// Moves to the next element: in ASCII a line of its own.
  void begin_element() {
    if (!ascii_) return;
    line_ = {};
    while (!text_.empty() && line_.find_first_not_of(" \t") == std::string_view::npos)
      line_ = take_line(text_);
  }
  /// Whether the element took all of its line, and nothing was missing.
  bool end_element() {
    if (ascii_ && line_.find_first_not_of(" \t") != std::string_view::npos) ok_ = false;
    return ok();
  }
  bool ok() const { return ok_ && binary_.ok(); }
  /// Whether only line ends are left.
  bool at_end() const {
    const std::string_view rest = ascii_ ? text_ : text_.substr(binary_.position());
    return rest.find_first_not_of(ascii_ ? " \t\r\n" : "\r\n") == std::string_view::npos;
  }
  /// Whether fewer than `count` values of this type are left.
  bool lacks(std::uint64_t count, PlyType type) const {
    return ascii_ ? count > line_.size() : count > binary_.left() / bytes_of(type);
  }

  double number(PlyType type) {
    if (ascii_) return number_in_text();
    switch (type) {
      case PlyType::i8:
        return static_cast<std::int8_t>(binary_.u8());
      case PlyType::u8:
        return binary_.u8();
      case PlyType::i16:
        return static_cast<std::int16_t>(binary_.u16());
      case PlyType::u16:
        return binary_.u16();
      case PlyType::i32:
        return static_cast<std::int32_t>(binary_.u32());
      case PlyType::u32:
        return binary_.u32();
      case PlyType::f32:
        return static_cast<double>(binary_.f32());
      case PlyType::f64:
        break;
    }
    return binary_.f64();
  }

 private:
  double number_in_text() {
    std::string_view word = take_word(line_);
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size()) ok_ = false;
    return value;
  }

  bool ok_ = true;
  bool ascii_;
  std::string_view text_;
  std::string_view line_;
  ByteReader binary_;
};

/// The length of a list, checked against the remaining data.
Result<std::size_t> list_length(PlyBody& body, const PlyProperty& property) {
  const double length = body.number(property.length_type);
  if (!body.ok()) return too_short();
  constexpr double kMost = 4294967295.0;
  if (!(length >= 0.0 && length <= kMost) || length != std::floor(length))
    return invalid_input("states a list of no length");
  if (body.lacks(static_cast<std::uint64_t>(length), property.type)) return too_short();
  return static_cast<std::size_t>(length);
}

Result<void> skip(PlyBody& body, const PlyProperty& property) {
  std::size_t count = 1;
  if (property.is_list) {
    const auto length = list_length(body, property);
    if (!length) return length.error();
    count = *length;
  }
  for (std::size_t k = 0; k < count; ++k) body.number(property.type);
  return {};
}

/// Calls `take` for each property of each element of one kind.
Result<void> visit_element(PlyBody& body, const PlyElement& element,
                           const std::function<Result<void>(std::size_t property)>& take) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin_element();
    for (std::size_t p = 0; p < element.properties.size(); ++p)
      if (auto taken = take(p); !taken) return taken;
    if (!body.end_element())
      return invalid_input(element.name + " " + std::to_string(i) + " is not what the header states");
  }
  return {};
}

/// Indices of x, y, z and of nx, ny, nz among an element's properties; the number of properties if absent.
std::array<std::size_t, 6> places_of_vectors(const PlyElement& element) {
  constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "nx", "ny", "nz"};
  std::array<std::size_t, 6> places{};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                    [&](const PlyProperty& p) { return p.name == kNames[k] && !p.is_list; });
    places[k] = static_cast<std::size_t>(found - element.properties.begin());
  }
  return places;
}

Result<PointCloud> read_vertices(PlyBody& body, const PlyElement& element) {
  if (element.count > kMostPoints) return invalid_input("has more than 50 million points");
  const auto places = places_of_vectors(element);
  const std::size_t none = element.properties.size();
  const auto has = [&](std::size_t first) {
    return std::all_of(places.begin() + static_cast<std::ptrdiff_t>(first),
                       places.begin() + static_cast<std::ptrdiff_t>(first + 3),
                       [none](std::size_t place) { return place != none; });
  };
  if (!has(0)) return invalid_input("has vertices without x, y and z");
  const bool normals = has(3);
  PointCloud cloud;
  cloud.places_m.reserve(element.count);
  if (normals) cloud.normals.reserve(element.count);
  std::vector<double> row(none);
  auto visited = visit_element(body, element, [&](std::size_t p) -> Result<void> {
    if (element.properties[p].is_list) {
      if (auto skipped = skip(body, element.properties[p]); !skipped) return skipped;
    } else {
      row[p] = body.number(element.properties[p].type);
    }
    // The last property completes the vertex; missing data are reported as damage of the element.
    if (p + 1 < none || !body.ok()) return {};
    const Vec3 place{row[places[0]], row[places[1]], row[places[2]]};
    if (!is_finite(place))
      return invalid_input("vertex " + std::to_string(cloud.places_m.size()) +
                           " has a coordinate that is not a finite number");
    cloud.places_m.push_back(place);
    if (normals) cloud.normals.push_back({row[places[3]], row[places[4]], row[places[5]]});
    return {};
  });
  if (!visited) return visited.error();
  return cloud;
}

/// Reads one list of corners; -1 is allowed only between the strips of `tristrips`.
Result<void> read_corners(PlyBody& body, const PlyProperty& property, std::vector<double>& corners) {
  const auto length = list_length(body, property);
  if (!length) return length.error();
  corners.resize(*length);
  for (double& corner : corners) corner = body.number(property.type);
  return {};
}

Result<std::uint32_t> index_of(double corner, std::size_t vertices) {
  if (!(corner >= 0.0) || corner >= static_cast<double>(vertices) || corner != std::floor(corner))
    return invalid_input("has a face with a corner that is no vertex of the file");
  return static_cast<std::uint32_t>(corner);
}

Result<void> append_face(const std::vector<double>& list, Mesh& mesh, std::vector<std::uint32_t>& corners) {
  corners.clear();
  for (const double corner : list) {
    const auto index = index_of(corner, mesh.vertices_m.size());
    if (!index) return index.error();
    corners.push_back(*index);
  }
  if (corners.size() > kMostCorners)
    return invalid_input("has a face of more than " + std::to_string(kMostCorners) + " corners");
  if (corners.size() >= 3) append_triangles(mesh.vertices_m, corners, mesh.triangles);
  return {};
}

/// In a strip every other triangle has the opposite orientation; -1 begins a new strip.
Result<void> append_strips(const std::vector<double>& list, Mesh& mesh) {
  std::vector<std::uint32_t> strip;
  for (const double corner : list) {
    if (corner == -1.0) {
      strip.clear();
      continue;
    }
    const auto index = index_of(corner, mesh.vertices_m.size());
    if (!index) return index.error();
    strip.push_back(*index);
    const std::size_t n = strip.size();
    if (n < 3) continue;
    const bool over = n % 2 == 0;
    mesh.triangles.push_back({strip[n - 3], strip[over ? n - 1 : n - 2], strip[over ? n - 2 : n - 1]});
  }
  return {};
}

bool is_corner_list(const PlyElement& element, const PlyProperty& property) {
  return property.is_list && (element.name == "face" || element.name == "tristrips") &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

Result<void> read_faces(PlyBody& body, const PlyElement& element, Mesh& mesh) {
  std::vector<double> list;
  std::vector<std::uint32_t> corners;
  return visit_element(body, element, [&](std::size_t p) -> Result<void> {
    const PlyProperty& property = element.properties[p];
    if (!is_corner_list(element, property)) return skip(body, property);
    if (auto read = read_corners(body, property, list); !read) return read;
    // Missing data are reported as damage of the element.
    if (!body.ok()) return {};
    auto appended = element.name == "face" ? append_face(list, mesh, corners) : append_strips(list, mesh);
    if (appended && mesh.triangles.size() > kMostTriangles)
      return invalid_input("has more than 20 million triangles; simplify it first");
    return appended;
  });
}

Result<void> skip_element(PlyBody& body, const PlyElement& element) {
  return visit_element(body, element, [&](std::size_t p) { return skip(body, element.properties[p]); });
}

enum class Wanted : std::uint8_t { points, faces };

struct PlyContent {
  PointCloud points;
  Mesh mesh;
};

Result<PlyContent> read_content(std::span<const std::byte> file, Wanted wanted) {
  const auto header = parse_ply_header(file);
  if (!header) return header.error();
  PlyBody body(*header);
  PlyContent content;
  bool has_vertices = false;
  for (const PlyElement& element : header->elements) {
    Result<void> read;
    if (element.name == "vertex" && !has_vertices) {
      auto vertices = read_vertices(body, element);
      if (!vertices) return vertices.error();
      content.points = *std::move(vertices);
      if (wanted == Wanted::faces) content.mesh.vertices_m = std::move(content.points.places_m);
      has_vertices = true;
    } else if (wanted == Wanted::faces && (element.name == "face" || element.name == "tristrips")) {
      if (!has_vertices) return invalid_input("states its faces before its vertices");
      read = read_faces(body, element, content.mesh);
    } else {
      read = skip_element(body, element);
    }
    if (!read) return read.error();
  }
  if (!body.at_end()) return too_long();
  return content;
}

}  // namespace

Result<Mesh> decode_ply_mesh(std::span<const std::byte> file) {
  auto content = read_content(file, Wanted::faces);
  if (!content) return content.error();
  return std::move(content->mesh);
}

Result<PointCloud> decode_ply_points(std::span<const std::byte> file) {
  auto content = read_content(file, Wanted::points);
  if (!content) return content.error();
  return std::move(content->points);
}

}  // namespace palpable::sources
