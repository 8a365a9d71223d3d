// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/mesh_parser.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/solid/mesh_check.hpp"
#include "palpable/sources/solid/ply_file.hpp"
#include "palpable/sources/solid/relative_text.hpp"

#include <exception>
#include <new>
#include <utility>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace palpable::sources {
namespace {

/// In double precision: a node far from the origin would round the shape of its mesh, and Assimp's own
/// transformation (aiProcess_PreTransformVertices) leaves out those below a hundredth.
using Transform = aiMatrix4x4t<double>;

/// Appends a mesh of a node.
Result<void> append(const aiMesh& part, const Transform& world, Mesh& mesh) {
  if (mesh.triangles.size() + part.mNumFaces > kMostTriangles)
    return invalid_input("has more than 20 million triangles; simplify it first");
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    const auto at = world * aiVector3t<double>(static_cast<double>(p.x), static_cast<double>(p.y),
                                               static_cast<double>(p.z));
    mesh.vertices_m.push_back({at.x, at.y, at.z});
  }
  // A mirrored mesh is turned inside out otherwise.
  const bool is_mirrored = world.Determinant() < 0.0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const auto corner = [&](unsigned k) { return first + face.mIndices[k]; };
    mesh.triangles.push_back({corner(0), corner(is_mirrored ? 2 : 1), corner(is_mirrored ? 1 : 2)});
  }
  return {};
}

Result<Mesh> mesh_from(const aiScene& scene) {
  Mesh mesh;
  std::vector<std::pair<const aiNode*, Transform>> left{{scene.mRootNode, Transform()}};
  while (!left.empty()) {
    const auto [node, parent] = left.back();
    left.pop_back();
    const Transform world = parent * static_cast<Transform>(node->mTransformation);
    for (unsigned k = 0; k < node->mNumMeshes; ++k)
      if (auto appended = append(*scene.mMeshes[node->mMeshes[k]], world, mesh); !appended)
        return std::move(appended).error();
    // In their order.
    for (unsigned k = node->mNumChildren; k > 0; --k) left.emplace_back(node->mChildren[k - 1], world);
  }
  if (mesh.triangles.empty()) return invalid_input("is a mesh without triangles");
  return mesh;
}

std::optional<RelativeText> relative_text_of(std::span<const std::byte> file, const std::string& ending) {
  if (ending == "obj") return relative_to_its_place(as_text(file), "v");
  const bool is_text_stl = ending == "stl" && stated_stl_bytes(file) != file.size();
  return is_text_stl ? relative_to_its_place(as_text(file), "vertex") : std::nullopt;
}

Result<Mesh> parse_by_assimp(std::span<const std::byte> file, const std::string& ending) {
  // Assimp's own message names its functions, which does not help a user.
  const Error unreadable = invalid_input(
      "cannot be read as a mesh: what it holds is not valid for a file of this kind (" + ending + ")");
  try {
    Assimp::Importer importer;
    // Lines and points are not surfaces.
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_LINE | aiPrimitiveType_POINT);
    const aiScene* scene = importer.ReadFileFromMemory(
        file.data(), file.size(), aiProcess_Triangulate | aiProcess_SortByPType, ending.c_str());
    if (scene == nullptr || scene->mRootNode == nullptr) return unreadable;
    return mesh_from(*scene);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::failed, "needs more memory than there is", {}};
  } catch (const std::exception&) {
    return unreadable;
  }
}

}  // namespace

Result<Mesh> parse_mesh(std::span<const std::byte> file, const std::string& ending) {
  if (const auto whole = check_mesh_file(file, ending); !whole) return whole.error();
  const auto relative = relative_text_of(file, ending);
  if (!relative) return parse_by_assimp(file, ending);
  auto mesh = parse_by_assimp(as_bytes(relative->text), ending);
  if (mesh)
    for (Vec3& v : mesh->vertices_m) v += relative->origin;
  return mesh;
}

}  // namespace palpable::sources
