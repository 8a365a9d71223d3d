// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/points_file.hpp"

#include "palpable/core/read_file.hpp"
#include "palpable/sources/solid/ply_header.hpp"

#include <assimp/Importer.hpp>
#include <assimp/scene.h>

namespace palpable::sources {
namespace {

constexpr std::size_t kMostPoints = 50'000'000;

Vec3 vec3_of(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Result<PointCloud> points_from(const aiScene& scene) {
  PointCloud cloud;
  bool normals = true;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    normals = normals && part.HasNormals();
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      cloud.places_m.push_back(vec3_of(part.mVertices[v]));
      if (normals) cloud.normals.push_back(vec3_of(part.mNormals[v]));
    }
    if (cloud.places_m.size() > kMostPoints) return invalid_input("has more than 50 million points");
  }
  if (!normals) cloud.normals.clear();
  if (cloud.places_m.empty()) return invalid_input("holds no points");
  return cloud;
}

}  // namespace

Result<PointCloud> decode_points(std::span<const std::byte> file) {
  if (const auto whole = check_ply(file); !whole) return whole.error();
  try {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(file.data(), file.size(), 0U, "ply");
    if (scene == nullptr)
      return invalid_input(std::string("cannot be read as points: ") + importer.GetErrorString());
    return points_from(*scene);
  } catch (const std::exception& e) {
    return invalid_input(std::string("cannot be read as points: ") + e.what());
  }
}

Result<PointCloud> read_points(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  auto cloud = decode_points(*file);
  if (!cloud) cloud.error().place = path.string();
  return cloud;
}

}  // namespace palpable::sources
