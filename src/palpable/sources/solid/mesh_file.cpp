// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/mesh_file.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/file_bytes.hpp"
#include "palpable/sources/city_json.hpp"
#include "palpable/sources/solid/mesh_check.hpp"
#include "palpable/sources/solid/mesh_reply.hpp"
#include "palpable/sources/solid/ply_file.hpp"

#include <algorithm>

namespace palpable::sources {
namespace {

bool is_ply(std::span<const std::byte> file) { return has_magic(file, "ply\n") || has_magic(file, "ply\r"); }

std::span<const std::byte> start_of(std::span<const std::byte> file) {
  return file.first(std::min<std::size_t>(file.size(), 4096));
}

/// The format by content, as kind_of_file() recognises it, since names may be wrong. Only a truncated binary
/// STL is recognised by its name.
std::string ending_of(std::span<const std::byte> file, const std::filesystem::path& path) {
  if (has_magic(file, "glTF")) return "glb";
  if (is_ply(file)) return "ply";
  const std::string_view start = as_text(start_of(file));
  if (has_magic(file, "solid") && start.find("facet") != std::string_view::npos) return "stl";
  if (stated_stl_bytes(file) == file.size()) return "stl";
  return is_named_stl(path) ? "stl" : "obj";
}

}  // namespace

Result<Mesh> decode_mesh(FileView file, const std::string& ending) {
  if (ending != "ply") return isolated::decode_mesh(file, ending);
  auto mesh = decode_ply_mesh(file);
  if (mesh && mesh->triangles.empty()) return invalid_input("is a mesh without triangles");
  return mesh;
}

Result<MeshFile> read_mesh(const std::filesystem::path& path) {
  const auto read = read_file_bytes(path, [](std::span<const std::byte> start) { return !is_ply(start); });
  if (!read) return read.error();
  const FileView file = read->view();
  if (is_city_json(as_text(start_of(file))))
    return invalid_input("is CityJSON, which is not read here yet: give an OBJ, PLY, STL or GLB file",
                         path.string());
  const std::string ending = ending_of(file, path);
  auto mesh = decode_mesh(file, ending);
  if (!mesh) {
    mesh.error().place = path.string();
    return mesh.error();
  }
  return MeshFile{std::move(*mesh), convention_of_format(ending)};
}

CoordinateConvention convention_of_format(const std::string& ending) {
  if (ending == "glb") return {AxisDirection::plus_y, LengthUnit::metre};
  return {ending == "stl" ? AxisDirection::plus_z : AxisDirection::plus_y, LengthUnit::unknown};
}

}  // namespace palpable::sources
