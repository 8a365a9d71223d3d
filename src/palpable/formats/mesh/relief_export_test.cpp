// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/mesh.hpp"
#include "palpable/formats/mesh/glb.hpp"
#include "palpable/formats/mesh/stl.hpp"
#include "palpable/models/relief/relief_solid.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

models::Relief cone() {
  Raster<float> z(61, 41);
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 61; ++x)
      z(x, y) = static_cast<float>(std::max(0.0, 0.010 - 0.0005 * std::hypot(x - 30.0, y - 20.0)));
  return *models::Relief::from_samples(std::move(z), 0.001);
}

template <class T>
T at(const std::vector<std::byte>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST(EncodeStl, IsWatertightAndOfTrueSize) {
  const Mesh solid = models::solid_of(cone());
  const auto file = encode_stl(solid);
  ASSERT_TRUE(file);
  const auto count = at<std::uint32_t>(*file, 80);
  ASSERT_EQ(file->size(), 84U + 50U * count);
  // Bitwise equal corners become one vertex, as in slicing programs.
  std::map<std::array<float, 3>, std::uint32_t> numbers;
  Mesh read;
  float low = 1e9F;
  float high = -1e9F;
  for (std::size_t k = 0; k < count; ++k) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto p = at<std::array<float, 3>>(*file, 84 + 50 * k + 12 * (corner + 1));
      const auto [found, is_new] = numbers.emplace(p, static_cast<std::uint32_t>(numbers.size()));
      if (is_new) read.vertices_m.push_back({double{p[0]}, double{p[1]}, double{p[2]}});
      triangle[corner] = found->second;
      low = std::min(low, p[0]);
      high = std::max(high, p[0]);
    }
    read.triangles.push_back(triangle);
  }
  EXPECT_TRUE(is_watertight(read));
  EXPECT_NEAR(high - low, 61.0F, 0.001F) << "millimetres";
}

TEST(EncodeGlb, HasConsistentPartsAndThePicture) {
  const Mesh solid = models::solid_of(cone());
  const auto file = encode_glb(solid, Raster<Rgb8>(8, 6, {200, 10, 20}));
  ASSERT_TRUE(file);
  EXPECT_EQ(at<std::uint32_t>(*file, 8), file->size());
  const auto json_size = at<std::uint32_t>(*file, 12);
  ASSERT_EQ(json_size % 4, 0U);
  const auto document =
      nlohmann::json::parse(std::string_view(reinterpret_cast<const char*>(file->data()) + 20, json_size));
  const auto binary_size = at<std::uint32_t>(*file, 20 + json_size);
  EXPECT_EQ(file->size(), 28U + json_size + binary_size);
  std::size_t covered = 0;
  for (const auto& view : document["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"], covered);
    covered += view["byteLength"].get<std::size_t>();
  }
  EXPECT_EQ(covered, binary_size);
  EXPECT_EQ(document["accessors"].size(), 4U);
  EXPECT_EQ(document["accessors"][3]["count"], 3 * solid.triangles.size());
  EXPECT_EQ(document["images"][0]["mimeType"], "image/png");
  EXPECT_FALSE(encode_glb(Mesh{}));
}

TEST(EncodeGlb, TakesNormalsThatAreGiven) {
  const Mesh solid = models::solid_of(cone());
  const std::vector<Vec3> normals(solid.vertices_m.size(), Vec3{0, 1, 0});
  const auto file = encode_glb(solid, {}, {}, normals);
  ASSERT_TRUE(file);
  const auto json_size = at<std::uint32_t>(*file, 12);
  // The positions come first, three floats each, then the normals.
  const std::size_t first = 28 + json_size + 12 * solid.vertices_m.size();
  EXPECT_EQ(at<float>(*file, first), 0.0F);
  EXPECT_EQ(at<float>(*file, first + 4), 1.0F);
}

TEST(EncodeGlb, HasALinearColourForEachVertexIfColoursAreGiven) {
  const Mesh solid = models::solid_of(cone());
  const std::vector<Rgb8> colours(solid.vertices_m.size(), Rgb8{255, 188, 0});
  const auto file = encode_glb(solid, {}, colours);
  ASSERT_TRUE(file);
  const auto json_size = at<std::uint32_t>(*file, 12);
  const auto document =
      nlohmann::json::parse(std::string_view(reinterpret_cast<const char*>(file->data()) + 20, json_size));
  const auto accessor = document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"].get<std::size_t>();
  EXPECT_EQ(document["accessors"][accessor]["count"], solid.vertices_m.size());
  EXPECT_EQ(document["accessors"][accessor]["normalized"], true);
  const auto view = document["accessors"][accessor]["bufferView"].get<std::size_t>();
  const auto first = 28 + json_size + document["bufferViews"][view]["byteOffset"].get<std::size_t>();
  EXPECT_EQ(at<std::uint16_t>(*file, first), 65535);
  // sRGB 188 is about half of the light.
  EXPECT_NEAR(at<std::uint16_t>(*file, first + 2), 0.5 * 65535, 700);
  EXPECT_EQ(at<std::uint16_t>(*file, first + 4), 0);
  EXPECT_EQ(at<std::uint16_t>(*file, first + 6), 65535);
}

}  // namespace
}  // namespace palpable::formats
