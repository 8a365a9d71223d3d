// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/vdb/vdb.hpp"
#include "palpable/formats/vdb/vdb_tree.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

constexpr std::string_view kMagic(" BDV\0\0\0\0", 8);
/// Format 222 is from 2013; 224, from 2017, is the newest known one.
constexpr std::uint32_t kOldest = 222, kNewest = 224;

std::string_view read_text(ByteReader& reader) { return as_text(reader.bytes(reader.u32())); }

/// Reads a grid's metadata and returns its class: "level set", "fog volume", "staggered", "unknown" or none.
std::string_view read_class(ByteReader& reader) {
  std::string_view kind;
  const std::uint32_t count = reader.u32();
  for (std::uint32_t i = 0; i < count && reader.ok(); ++i) {
    const std::string_view name = read_text(reader);
    read_text(reader);  // The entry's type.
    const std::string_view value = read_text(reader);
    if (name == "class") kind = value;
  }
  return kind;
}

struct Header {
  bool offsets = false;
  std::uint32_t grids = 0;
};

Result<Header> read_header(ByteReader& reader) {
  reader.skip(kMagic.size());
  const std::uint32_t version = reader.u32();
  if (reader.ok() && (version < kOldest || version > kNewest))
    return invalid_input(fmt::format("is an OpenVDB file of format {}, of which {} to {} are read", version,
                                     kOldest, kNewest));
  reader.skip(2 * 4);  // The library's version.
  Header header;
  header.offsets = reader.u8() != 0;
  constexpr std::size_t kIdentityBytes = 36;
  reader.skip(kIdentityBytes);
  read_class(reader);
  header.grids = reader.u32();
  return header;
}

/// A grid's position in the file, and its header.
struct Grid {
  std::string_view type, kind;
  VdbCoding coding;
  LevelSet places;
  std::size_t tree = 0;
};

Vec3 read_vec3(ByteReader& reader) {
  const double x = reader.f64(), y = reader.f64(), z = reader.f64();
  return {x, y, z};
}

/// Reads the transform from grid indices to space; false if it is not linear.
bool read_places(ByteReader& reader, LevelSet& set) {
  const std::string_view map = read_text(reader);
  Vec3 scale{1.0, 1.0, 1.0};
  set.origin_m = {};
  if (map == "AffineMap" || map == "UnitaryMap") {
    // A 4 x 4 matrix for row vectors.
    for (Vec3& step : set.steps_m) {
      step = read_vec3(reader);
      reader.f64();
    }
    set.origin_m = read_vec3(reader);
    reader.f64();
    return true;
  }
  if (map == "TranslationMap") {
    set.origin_m = read_vec3(reader);
  } else if (map == "ScaleMap" || map == "UniformScaleMap" || map == "ScaleTranslateMap" ||
             map == "UniformScaleTranslateMap") {
    if (map.find("Translate") != std::string_view::npos) set.origin_m = read_vec3(reader);
    scale = read_vec3(reader);
    for (int told_again = 0; told_again < 4; ++told_again) read_vec3(reader);
  } else {
    return false;
  }
  set.steps_m = {Vec3{scale.x, 0.0, 0.0}, Vec3{0.0, scale.y, 0.0}, Vec3{0.0, 0.0, scale.z}};
  return true;
}

/// The grid that begins here; nullopt with `reason` if it cannot be read as a level set.
std::optional<Grid> read_grid(ByteReader& reader, std::string_view type, std::string& reason) {
  Grid grid;
  grid.type = type;
  constexpr std::string_view kFloats = "Tree_float_5_4_3", kHalves = "Tree_float_5_4_3_HalfFloat";
  if (type == kHalves) grid.coding.numbers = VdbCoding::Numbers::half;
  grid.coding.compression = reader.u32();
  grid.kind = read_class(reader);
  if (type != kFloats && type != kHalves) {
    reason = fmt::format("of type {}, not floats", type.substr(0, 40));
    return std::nullopt;
  }
  if (grid.kind == "fog volume" || grid.kind == "staggered") {
    reason = fmt::format("a {}, not a level set", grid.kind);
    return std::nullopt;
  }
  if (!read_places(reader, grid.places)) {
    reason = "not on a regular grid";
    return std::nullopt;
  }
  grid.tree = reader.position();
  return grid;
}

/// The first level set, else the first grid that may be one.
Result<Grid> find_grid(ByteReader& reader, const Header& header) {
  std::optional<Grid> found;
  std::string reason;
  for (std::uint32_t i = 0; i < header.grids && reader.ok(); ++i) {
    read_text(reader);  // The grid's name.
    const std::string_view type = read_text(reader);
    const bool shared = !read_text(reader).empty();
    const std::uint64_t begin = reader.u64();
    reader.u64();  // Where its values begin.
    const std::uint64_t end = reader.u64();
    if (header.offsets && (begin > end || end > reader.position() + reader.left())) break;
    if (header.offsets) reader.seek(static_cast<std::size_t>(begin));
    // An instance grid has its tree elsewhere.
    auto grid = shared ? std::nullopt : read_grid(reader, type, reason);
    if (grid && reader.ok() && (!found || (found->kind != "level set" && grid->kind == "level set")))
      found = grid;
    // Without offsets only the first grid can be reached.
    if (!header.offsets) break;
    reader.seek(static_cast<std::size_t>(end));
  }
  if (found) return *found;
  if (!reader.ok() || reason.empty())
    return invalid_input("is a damaged or cut-off OpenVDB file, or has no grid");
  return invalid_input("holds no level set that can be read: its grid is " + reason);
}

bool regular(const LevelSet& set) {
  const auto& s = set.steps_m;
  const double volume_m3 = std::abs(dot(s[0], cross(s[1], s[2])));
  const double longest_m = std::max({norm(s[0]), norm(s[1]), norm(s[2])});
  constexpr double kMost_m = 1e6;
  return is_finite(set.origin_m) && norm(set.origin_m) < kMost_m && longest_m < kMost_m &&
         volume_m3 > 1e-6 * longest_m * longest_m * longest_m && volume_m3 > 1e-30;
}

}  // namespace

bool is_vdb(std::span<const std::byte> file) { return has_magic(file, kMagic); }

Result<LevelSet> decode_vdb(std::span<const std::byte> file) {
  ByteReader reader(file);
  if (!is_vdb(file)) return invalid_input("is not an OpenVDB file");
  const auto header = read_header(reader);
  if (!header) return header.error();
  const auto grid = find_grid(reader, *header);
  if (!grid) return grid.error();
  ByteReader tree(file);
  tree.seek(grid->tree);
  auto set = read_vdb_tree(tree, grid->coding);
  if (!set) return set.error();
  set->origin_m = grid->places.origin_m;
  set->steps_m = grid->places.steps_m;
  if (!regular(*set)) return invalid_input("is an OpenVDB file whose grid has no finite size");
  if (set->blocks.empty() || !(set->background > 0.0F))
    return invalid_input("is an OpenVDB file whose level set is empty");
  return set;
}

Result<LevelSet> read_vdb(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  auto set = decode_vdb(*file);
  if (!set) set.error().place = path.string();
  return set;
}

}  // namespace palpable::formats
