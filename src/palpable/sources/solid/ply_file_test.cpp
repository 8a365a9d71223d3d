// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/ply_file.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

Result<Mesh> mesh(const std::string& text) { return decode_ply_mesh(as_bytes(text)); }
Result<PointCloud> points(const std::string& text) { return decode_ply_points(as_bytes(text)); }

std::string header(const std::string& format, int vertices, int faces) {
  return "ply\nformat " + format + " 1.0\ncomment made by a test\nelement vertex " +
         std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

template <class T>
void put(std::string& out, T value, std::endian order) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (order != std::endian::native) std::reverse(raw, raw + sizeof(T));
  out.append(raw, sizeof(T));
}

/// A square pyramid: one quadrilateral, four triangles.
std::string binary_pyramid(std::endian order) {
  std::string file = header(order == std::endian::big ? "binary_big_endian" : "binary_little_endian", 5, 5);
  const float places[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5F, 0.5F, 1}};
  for (const auto& place : places)
    for (const float v : place) put(file, v, order);
  const std::vector<std::vector<std::int32_t>> faces{
      {0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  for (const auto& face : faces) {
    file += static_cast<char>(face.size());
    for (const std::int32_t corner : face) put(file, corner, order);
  }
  return file;
}

const std::string kTriangle = header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1e-1 0\n3 0 1 2\n";

TEST(PlyFile, ReadsBothByteOrdersAndTextAlike) {
  for (const auto order : {std::endian::little, std::endian::big}) {
    const auto read = mesh(binary_pyramid(order));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->vertices_m.size(), 5U);
    EXPECT_EQ(read->triangles.size(), 6U);
    EXPECT_TRUE(is_watertight(*read));
    EXPECT_EQ(read->vertices_m[4], (Vec3{0.5, 0.5, 1.0}));
  }
  const auto text = mesh(kTriangle);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(text->vertices_m[2], (Vec3{0.0, 0.1, 0.0}));
}

TEST(PlyFile, ReadsPointsWithNormalsAndSkipsWhatItDoesNotKnow) {
  const auto cloud = points(
      "ply\r\nformat ascii 1.0\r\nelement vertex 2\r\nproperty double x\r\nproperty double y\r\n"
      "property double z\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
      "property list uchar float weights\r\nelement edge 1\r\nproperty int a\r\nend_header\r\n"
      "1 2 3 0 0 1 2 7 8\r\n4 5 6 0 1 0 0\r\n12\r\n");
  ASSERT_TRUE(cloud) << cloud.error().message;
  ASSERT_EQ(cloud->places_m.size(), 2U);
  EXPECT_EQ(cloud->places_m[1], (Vec3{4, 5, 6}));
  EXPECT_EQ(cloud->normals[1], (Vec3{0, 1, 0}));
}

TEST(PlyFile, SplitsStripsWithTheirOrientation) {
  const auto strip = mesh(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 2\n");
  ASSERT_TRUE(strip) << strip.error().message;
  ASSERT_EQ(strip->triangles.size(), 3U);
  for (const auto& t : strip->triangles)
    EXPECT_GT(cross(strip->vertices_m[t[1]] - strip->vertices_m[t[0]],
                    strip->vertices_m[t[2]] - strip->vertices_m[t[0]])
                  .z,
              0.0);
}

TEST(PlyFile, RefusesEveryTruncation) {
  for (const std::string& whole : {binary_pyramid(std::endian::little), kTriangle}) {
    ASSERT_TRUE(mesh(whole));
    // The newline after the last line may be missing.
    for (std::size_t bytes = 0; bytes + 1 < whole.size(); ++bytes) {
      const auto cut = mesh(whole.substr(0, bytes));
      ASSERT_FALSE(cut) << bytes << " of " << whole.size() << " bytes were taken for a whole file";
      EXPECT_EQ(cut.error().code, ErrorCode::invalid_input);
    }
  }
}

TEST(PlyFile, RefusesMoreThanTheHeaderStates) {
  EXPECT_FALSE(mesh(kTriangle + "3 0 1 2\n"));
  EXPECT_FALSE(mesh(binary_pyramid(std::endian::little) + "xyz"));
  EXPECT_TRUE(mesh(kTriangle + "\n \n"));
  EXPECT_FALSE(mesh(header("ascii", 3, 1) + "0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n"));
}

TEST(PlyFile, RefusesInvalidIndicesAndCoordinates) {
  EXPECT_FALSE(mesh(header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"));
  EXPECT_FALSE(mesh(header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"));
  EXPECT_FALSE(mesh(header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n"));
  EXPECT_FALSE(mesh(header("ascii", 3, 1) + "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_FALSE(mesh(header("ascii", 3, 1) + "0 0 0\n1e999 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_FALSE(mesh(header("ascii", 3, 1) + "0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n"));
}

TEST(PlyFile, SurvivesChangedBytes) {
  std::mt19937 random(7);
  const auto pick = [&random](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  std::size_t taken = 0;
  for (const std::string& whole : {binary_pyramid(std::endian::little), kTriangle})
    for (int k = 0; k < 5000; ++k) {
      std::string changed = whole;
      for (std::size_t n = pick(4) + 1; n > 0; --n)
        changed[pick(changed.size())] = static_cast<char>(pick(256));
      const auto read = mesh(changed);
      if (!read) continue;
      ++taken;
      for (const auto& t : read->triangles)
        for (const std::uint32_t corner : t) ASSERT_LT(corner, read->vertices_m.size());
      for (const Vec3& v : read->vertices_m) ASSERT_TRUE(is_finite(v));
    }
  EXPECT_GT(taken, 100U);
}

}  // namespace
}  // namespace palpable::sources
