// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/vdb/vdb.hpp"

#include "palpable/core/system/child_process.hpp"
#include "palpable/models/field/distance_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

constexpr Vec3 kNormal{0.6, 0.0, 0.8};
constexpr double kOffset_m = -0.015;

/// Everything below a tilted plane, in a box of 32 mm.
models::DistanceField half_space() {
  const auto word = [](double v) { return std::bit_cast<std::uint32_t>(static_cast<float>(v)); };
  models::FieldTree tree;
  tree.roots.assign(8, models::FieldTree::kLeaf);
  tree.words = {0U, word(kNormal.x), word(kNormal.y), word(kNormal.z), word(kOffset_m)};
  auto field = models::DistanceField::from_tree({{-0.01, 0.0, 0.002}, 0.001, 4, {2, 2, 2}}, tree, {});
  EXPECT_TRUE(field.has_value());
  return *std::move(field);
}

std::vector<std::byte> encoded(VdbBand band) {
  auto bytes = encode_vdb(half_space(), {0.0005, band}, Work{});
  EXPECT_TRUE(bytes.has_value());
  return bytes ? *std::move(bytes) : std::vector<std::byte>{};
}

void expect_half_space(const LevelSet& set, double inside_m) {
  const models::DistanceField field = half_space();
  const double width_m = 3 * 0.0005;
  for (const LevelSet::Block& block : set.blocks)
    for (int i = 0; i < 512; ++i) {
      const Vec3 at{block.corner[0] + 1.0 * (i / 64), block.corner[1] + 1.0 * (i / 8 % 8),
                    block.corner[2] + 1.0 * (i % 8)};
      const Vec3 p = set.origin_m + at.x * set.steps_m[0] + at.y * set.steps_m[1] + at.z * set.steps_m[2];
      const double expected = std::clamp(field.sample({p}).distance_m, -inside_m, width_m);
      // Half floats have 11 significant bits.
      ASSERT_NEAR(static_cast<double>(block.values[static_cast<std::size_t>(i)]), expected,
                  1e-7 + std::abs(expected) / 2048.0);
    }
}

TEST(Vdb, ReadsANarrowBandThatOpenVdbWrote) {
  const auto set = decode_vdb(encoded(VdbBand::narrow));
  ASSERT_TRUE(set) << set.error().sentence();
  EXPECT_GT(set->blocks.size(), 50U);
  EXPECT_LT(set->blocks.size(), 400U);
  EXPECT_NEAR(static_cast<double>(set->background), 0.0015, 1e-6);
  expect_half_space(*set, 0.0015);
}

TEST(Vdb, ReadsTheWholeInsideThatOpenVdbWrote) {
  const auto narrow = decode_vdb(encoded(VdbBand::narrow)), full = decode_vdb(encoded(VdbBand::full));
  ASSERT_TRUE(narrow && full);
  EXPECT_GT(full->blocks.size(), narrow->blocks.size() + 50);
  expect_half_space(*full, 1.0);
}

TEST(Vdb, RefusesTooManyVoxels) {
  const auto bytes = encode_vdb(half_space(), {1e-6, VdbBand::narrow}, Work{});
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::usage);
}

TEST(Vdb, SaysThatItsWriterCannotBeLoaded) {
  for (const char* const module : {"/no/such/writer.so", "/etc/passwd"}) {
    ::setenv("PALPABLE_VDB_WRITER", module, 1);
    const auto bytes = encode_vdb(half_space(), {0.0005, VdbBand::narrow}, Work{});
    ::unsetenv("PALPABLE_VDB_WRITER");
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().code, ErrorCode::failed);
    EXPECT_NE(bytes.error().message.find("OpenVDB files cannot be written: "), std::string::npos);
    EXPECT_NE(bytes.error().message.find(module), std::string::npos) << bytes.error().message;
  }
}

TEST(Vdb, RefusesAWriterThatIsCutOff) {
  const auto whole = helper_module("palpable-vdb-writer.so", "PALPABLE_VDB_WRITER", "");
  ASSERT_TRUE(whole);
  const auto cut = std::filesystem::path(testing::TempDir()) / "cut-vdb-writer.so";
  for (const std::uintmax_t bytes : {10U, 1000U, 20000U, 300000U}) {
    std::filesystem::copy_file(*whole, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, bytes);
    ::setenv("PALPABLE_VDB_WRITER", cut.c_str(), 1);
    const auto written = encode_vdb(half_space(), {0.0005, VdbBand::narrow}, Work{});
    ::unsetenv("PALPABLE_VDB_WRITER");
    ASSERT_FALSE(written) << bytes;
    EXPECT_NE(written.error().message.find("is cut off"), std::string::npos) << written.error().message;
  }
  std::filesystem::remove(cut);
}

TEST(Vdb, RefusesAFileTruncatedAnywhere) {
  const auto bytes = encoded(VdbBand::narrow);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 40) {
    const auto set = decode_vdb(std::span(bytes).first(size));
    ASSERT_FALSE(set) << "cut after " << size << " of " << bytes.size();
    EXPECT_EQ(set.error().code, ErrorCode::invalid_input);
  }
}

TEST(Vdb, ReadsOrRefusesADamagedFileWithoutACrash) {
  const auto bytes = encoded(VdbBand::narrow);
  std::mt19937 random(5);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    auto damaged = bytes;
    // The first kilobyte holds all sizes.
    const std::size_t at = random() % (i % 2 == 0 ? 1024U : static_cast<unsigned>(bytes.size()));
    damaged[at] = std::byte{static_cast<std::uint8_t>(random())};
    const auto set = decode_vdb(damaged);
    if (!set) {
      ++refused;
      continue;
    }
    for (const LevelSet::Block& block : set->blocks)
      for (const float v : block.values) ASSERT_TRUE(std::isfinite(v));
  }
  EXPECT_GT(refused, 20);
}

std::filesystem::path example(const char* name) {
  return std::filesystem::path(PALPABLE_VDB_EXAMPLES) / name;
}

/// A ball of radius 4 around (10, 0, 0) with voxels of side 1, written by OpenVDB's Python module.
void expect_ball(const char* name) {
  const auto set = read_vdb(example(name));
  ASSERT_TRUE(set) << set.error().sentence();
  int inside = 0;
  for (const LevelSet::Block& block : set->blocks)
    for (int i = 0; i < 512; ++i) {
      const Vec3 at{block.corner[0] + 1.0 * (i / 64), block.corner[1] + 1.0 * (i / 8 % 8),
                    block.corner[2] + 1.0 * (i % 8)};
      const Vec3 p = set->origin_m + at.x * set->steps_m[0] + at.y * set->steps_m[1] + at.z * set->steps_m[2];
      const double expected = std::clamp(norm(p - Vec3{10.0, 0.0, 0.0}) - 4.0, -3.0, 3.0);
      ASSERT_NEAR(static_cast<double>(block.values[static_cast<std::size_t>(i)]), expected, 0.02);
      if (expected < 0.0) ++inside;
    }
  // The number of integer points nearer than 4.
  EXPECT_EQ(inside, 251);
}

TEST(Vdb, ReadsEveryCompression) {
  for (const char* name : {"ball_blosc.vdb", "ball_half.vdb", "ball_zip.vdb", "ball_plain.vdb"}) {
    SCOPED_TRACE(name);
    expect_ball(name);
  }
}

TEST(Vdb, FindsTheLevelSetAmongOtherGridsAndRefusesAFogVolume) {
  expect_ball("fog_and_ball.vdb");
  const auto fog = read_vdb(example("fog.vdb"));
  ASSERT_FALSE(fog);
  EXPECT_NE(fog.error().message.find("fog volume"), std::string::npos) << fog.error().sentence();
}

}  // namespace
}  // namespace palpable::formats
