// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/mesh_file.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

constexpr std::array<Vec3, 4> kCorners{Vec3{0, 0, 0}, Vec3{0.04, 0, 0}, Vec3{0, 0.03, 0}, Vec3{0, 0, 0.02}};
constexpr std::array<std::array<std::uint32_t, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
// The file states nanometres.
constexpr double kStated_m = 1e-9;

std::string obj_at(Vec3 place, const std::string& after_each_vertex = "") {
  std::string text = "# a tetrahedron\no solid\n";
  for (const Vec3& c : kCorners) {
    const Vec3 v = place + c;
    text += fmt::format("v {:.9f} {:.9f} {:.9f}{}\n", v.x, v.y, v.z, after_each_vertex);
  }
  for (const auto& f : kFaces) text += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
  return text;
}

std::string stl_at(Vec3 place) {
  std::string text = "solid tetrahedron\n";
  for (const auto& f : kFaces) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::uint32_t k : f) {
      const Vec3 v = place + kCorners[k];
      text += fmt::format("      vertex {:.9f} {:.9f} {:.9f}\n", v.x, v.y, v.z);
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

/// The greatest distance of a corner of the mesh from the nearest of the tetrahedron at `place`.
double error_of(const Mesh& mesh, Vec3 place) {
  double most = 0.0;
  for (const Vec3& v : mesh.vertices_m) {
    double nearest = 1e300;
    for (const Vec3& c : kCorners) nearest = std::min(nearest, norm(v - (place + c)));
    most = std::max(most, nearest);
  }
  return most;
}

TEST(MeshFile, InTextKeepsItsShapeFarFromItsOrigin) {
  for (const Vec3 place : {Vec3{0, 0, 0}, Vec3{5000, -2500, 10}, Vec3{6'378'137, 1e6, 2e6}})
    for (const auto& [text, ending] : {std::pair(obj_at(place), "obj"), std::pair(stl_at(place), "stl"),
                                       std::pair(obj_at(place, " 0.2 0.5 1"), "obj")}) {
      const auto mesh = decode_mesh(as_bytes(text), ending);
      ASSERT_TRUE(mesh) << ending << ' ' << mesh.error().message;
      EXPECT_EQ(mesh->triangles.size(), 4U);
      EXPECT_LT(error_of(*mesh, place), 2 * kStated_m) << ending << " at " << place.x;
    }
}

/// The tetrahedron as GLB, in the node that the JSON describes; `{}` in it stands for the mesh.
std::string glb_in(const std::string& nodes) {
  std::string binary;
  const auto put = [&binary](auto value) {
    binary.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Vec3& c : kCorners)
    for (const double v : {c.x, c.y, c.z}) put(static_cast<float>(v));
  for (const auto& f : kFaces)
    for (const std::uint32_t k : f) put(k);
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
      R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":96}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[0.04,0.03,0.02]},)"
      R"({"bufferView":1,"componentType":5125,"count":12,"type":"SCALAR"}]})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string chunks = [&] {
    const std::string content = std::move(binary);
    binary.clear();
    put(static_cast<std::uint32_t>(json.size()));
    binary += "JSON" + json;
    put(static_cast<std::uint32_t>(content.size()));
    binary += std::string("BIN\0", 4) + content;
    return std::move(binary);
  }();
  binary = "glTF";
  put(std::uint32_t{2});
  put(static_cast<std::uint32_t>(12 + chunks.size()));
  return binary + chunks;
}

Result<Mesh> glb_mesh_in(const std::string& nodes) { return decode_mesh(as_bytes(glb_in(nodes)), "glb"); }

double volume_of(const Mesh& mesh, Vec3 from) {
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    six_volumes +=
        dot(mesh.vertices_m[a] - from, cross(mesh.vertices_m[b] - from, mesh.vertices_m[c] - from));
  return six_volumes / 6.0;
}

TEST(MeshFile, GlbKeepsItsShapeInANodeFarFromTheOrigin) {
  // Numbers that single precision has.
  for (const Vec3 place : {Vec3{0, 0, 0}, Vec3{5000, -2500, 10}, Vec3{6'378'136, 1e6, 2e6}}) {
    const auto mesh = glb_mesh_in(
        fmt::format(R"({{"children":[1],"translation":[{},{},{}]}},{{"mesh":0,"translation":[2,0,0]}})",
                    place.x, place.y, place.z));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), 4U);
    EXPECT_LT(error_of(*mesh, place + Vec3{2, 0, 0}), 2 * kStated_m) << place.x;
  }
}

TEST(MeshFile, GlbMovesAMeshAlsoByMillimetres) {
  const auto mesh = glb_mesh_in(R"({"mesh":0,"translation":[0.005,0,0]})");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_LT(error_of(*mesh, {0.005, 0, 0}), 2 * kStated_m);
}

TEST(MeshFile, GlbInAMirroredNodeHasItsInsideWithin) {
  const auto plain = glb_mesh_in(R"({"mesh":0})"), mirrored = glb_mesh_in(R"({"mesh":0,"scale":[-1,1,1]})");
  ASSERT_TRUE(plain && mirrored);
  EXPECT_GT(volume_of(*plain, {}), 0.0);
  EXPECT_NEAR(volume_of(*mirrored, {}), volume_of(*plain, {}), 1e-12);
}

TEST(MeshFile, WithVerticesOfAnotherKindIsReadAsItIs) {
  // A fourth number is a weight, by which the others are divided.
  const auto weighted = decode_mesh(as_bytes(obj_at({5000, 0, 0}, " 2")), "obj");
  ASSERT_TRUE(weighted) << weighted.error().message;
  EXPECT_NEAR(weighted->vertices_m[0].x, 2500.0, 0.1);
}

TEST(MeshFile, WithAVertexThatIsNoneIsRefusedFarFromItsOriginToo) {
  EXPECT_FALSE(decode_mesh(as_bytes("v 5000 0\n" + obj_at({5000, 0, 0})), "obj"));
}

}  // namespace
}  // namespace palpable::sources
