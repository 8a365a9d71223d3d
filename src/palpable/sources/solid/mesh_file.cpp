// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/mesh_file.hpp"

#include "palpable/core/byte_reader.hpp"
#include "palpable/core/read_file.hpp"
#include "palpable/sources/city_json.hpp"
#include "palpable/sources/solid/mesh_check.hpp"
#include "palpable/sources/solid/mesh_reply.hpp"
#include "palpable/sources/solid/ply_file.hpp"

#include <new>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace palpable::sources {
namespace {

/// By content, as kind_of_file() recognises it; names lie. Only a binary STL that is cut off has nothing but
/// its name.
std::string ending_of(std::span<const std::byte> file, const std::filesystem::path& path) {
  if (has_magic(file, "glTF")) return "glb";
  if (has_magic(file, "ply\n") || has_magic(file, "ply\r")) return "ply";
  const std::string_view start = as_text(file.first(std::min<std::size_t>(file.size(), 4096)));
  if (has_magic(file, "solid") && start.find("facet") != std::string_view::npos) return "stl";
  if (stated_stl_bytes(file) == file.size()) return "stl";
  return is_named_stl(path) ? "stl" : "obj";
}

Result<Mesh> mesh_from(const aiScene& scene) {
  Mesh mesh;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& p = part.mVertices[v];
      mesh.vertices_m.push_back(
          {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      mesh.triangles.push_back(
          {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
    if (mesh.triangles.size() > kMostTriangles)
      return invalid_input("has more than 20 million triangles; simplify it first");
  }
  if (mesh.triangles.empty()) return invalid_input("is a mesh without triangles");
  return mesh;
}

}  // namespace

Result<Mesh> decode_mesh(std::span<const std::byte> file, const std::string& ending) {
  if (ending == "ply") {
    auto mesh = decode_ply_mesh(file);
    if (mesh && mesh->triangles.empty()) return invalid_input("is a mesh without triangles");
    return mesh;
  }
  if (const auto whole = check_mesh_file(file, ending); !whole) return whole.error();
  // The reader's own words name its functions, and mean nothing to a person.
  const Error unreadable = invalid_input(
      "cannot be read as a mesh: what it holds is not valid for a file of this kind (" + ending + ")");
  try {
    Assimp::Importer importer;
    // Lines and points are no surface; nodes' transforms are applied to their vertices.
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_LINE | aiPrimitiveType_POINT);
    const aiScene* scene = importer.ReadFileFromMemory(
        file.data(), file.size(),
        aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices, ending.c_str());
    if (scene == nullptr) return unreadable;
    return mesh_from(*scene);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::failed, "needs more memory than there is", {}};
  } catch (const std::exception&) {
    return unreadable;
  }
}

Result<MeshFile> read_mesh(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  if (is_city_json(as_text(std::span(*file).first(std::min<std::size_t>(file->size(), 4096)))))
    return invalid_input("is CityJSON, which is not read here yet: give an OBJ, PLY, STL or GLB file",
                         path.string());
  const std::string ending = ending_of(*file, path);
  auto mesh = ending == "ply" ? decode_mesh(*file, ending) : isolated::decode_mesh(*file, ending);
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
