// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/scene_file.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/formats/packing/float_block.hpp"
#include "palpable/formats/packing/zip.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/formats/scene/test_scene_file.hpp"
#include "palpable/models/field/field_leaf.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

TEST(SceneFile, KeepsATexturesPictureToFifteenBits) {
  models::Scene scene = sample();
  std::vector<float> tile(std::size_t{models::kTextureSide} * models::kTextureSide);
  for (std::size_t k = 0; k < tile.size(); ++k) tile[k] = std::sin(0.37F * static_cast<float>(k));
  tile[0] = -1.0F;
  tile[1] = 1.0F;
  scene.materials[1].texture = {models::TouchTexture::Kind::picture, 0.002, 2e-5, 0.5, tile};
  const auto file = encode_scene(scene);
  ASSERT_TRUE(file);
  const auto back = decode_scene(*file);
  ASSERT_TRUE(back) << back.error().sentence();
  const models::TouchTexture& texture = back->scene.materials[1].texture;
  EXPECT_EQ(texture.kind, models::TouchTexture::Kind::picture);
  ASSERT_EQ(texture.tile.size(), tile.size());
  for (std::size_t k = 0; k < tile.size(); ++k) EXPECT_NEAR(texture.tile[k], tile[k], 2e-5F);
  EXPECT_TRUE(back->others.empty());

  models::Scene broken = scene;
  broken.materials[1].texture.tile.pop_back();
  EXPECT_FALSE(encode_scene(broken));
}

TEST(SceneFile, KeepsTheSecondViewItsShiftExactly) {
  models::Scene scene = sample();
  models::SecondView view{Raster<Rgb8>(40, 30, {200, 100, 50}), Raster<std::uint16_t>(20, 15)};
  for (std::size_t k = 0; k < view.shift.count(); ++k)
    view.shift.values()[k] = static_cast<std::uint16_t>(211 * k);
  scene.second_view = std::make_shared<const models::SecondView>(view);
  const auto file = encode_scene(scene);
  ASSERT_TRUE(file);
  const auto back = decode_scene(*file);
  ASSERT_TRUE(back) << back.error().sentence();
  ASSERT_NE(back->scene.second_view, nullptr);
  EXPECT_EQ(back->scene.second_view->shift, view.shift);
  ASSERT_EQ(back->scene.second_view->picture.width(), 40);
  EXPECT_NEAR(back->scene.second_view->picture(5, 5).r, 200, 2);
  EXPECT_TRUE(back->others.empty());

  auto members = *unzip(*file);
  members.erase("second-view.jpg");
  EXPECT_FALSE(decode_scene(*zip(members)));
  members = *unzip(*file);
  members["second-view-shift.png"] = *encode_png(Raster<std::uint8_t>(20, 15));
  EXPECT_FALSE(decode_scene(*zip(members)));
}

TEST(SceneFile, KeepsEveryValueExactly) {
  const models::Scene scene = sample();
  const auto path = std::filesystem::path(testing::TempDir()) / "palpable-scene.palp";
  ASSERT_TRUE(write_scene(path, scene));
  const auto back = read_scene(path);
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->version, "1.0");
  EXPECT_EQ(back->file_bytes, std::filesystem::file_size(path));
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(back->scene.model);
  EXPECT_EQ(relief.samples_m(), hills(40, 30));
  EXPECT_EQ(relief.pixel_m(), 0.0025);
  EXPECT_EQ(back->scene.texture, scene.texture);
  EXPECT_EQ(back->scene.labels, scene.labels);
  ASSERT_EQ(back->scene.materials.size(), 2U);
  EXPECT_EQ(back->scene.materials[1].name, "glass \xC3\xA4");
  EXPECT_EQ(back->scene.materials[1].stiffness_N_per_m, 1200.5);
  EXPECT_EQ(back->scene.scene_from_input.translation_m, scene.scene_from_input.translation_m);
  EXPECT_EQ(back->scene.scene_from_input.scale, 1e-4);
  EXPECT_EQ(back->scene.source.inputs, scene.source.inputs);
  EXPECT_EQ(back->scene.source.command, scene.source.command);
  ASSERT_EQ(back->scene.source.files.size(), 1U);
  EXPECT_EQ(back->scene.source.files[0].name, "left.png");
  EXPECT_EQ(back->scene.source.files[0].bytes, 4U);
  EXPECT_EQ(back->scene.source.files[0].sha256, scene.source.files[0].sha256);
  EXPECT_EQ(back->scene.source.method, scene.source.method);
  EXPECT_TRUE(back->others.empty());
}

TEST(SceneFile, KeepsTheMakersTitleAndDescription) {
  models::Scene scene = sample();
  EXPECT_EQ(decode_scene(*encode_scene(scene))->scene.title, "");
  scene.title = "Das Rathaus \xC3\xA4";
  scene.description = "Seen from the south.\nThe tower is on the left.";
  const auto back = decode_scene(*encode_scene(scene));
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->scene.title, scene.title);
  EXPECT_EQ(back->scene.description, scene.description);
  scene.title = "two\nlines";
  EXPECT_FALSE(encode_scene(scene));
  scene.title = "";
  scene.description.assign(models::kMaxDescriptionBytes + 1, 'x');
  EXPECT_FALSE(encode_scene(scene));
}

TEST(SceneFile, KeepsWarnings) {
  models::Scene scene = sample();
  EXPECT_TRUE(decode_scene(*encode_scene(scene))->scene.warnings.empty());
  scene.warnings = {"Heights are out of proportion.", "The picture is dark."};
  EXPECT_EQ(decode_scene(*encode_scene(scene))->scene.warnings, scene.warnings);
  scene.warnings.assign(models::kMaxWarnings + 1, "Too many.");
  EXPECT_FALSE(encode_scene(scene));
  scene.warnings = {std::string(models::kMaxWarningBytes + 1, 'x')};
  EXPECT_FALSE(encode_scene(scene));
}

TEST(SceneFile, KeepsNamesOfPointsAndOfWhatTheyCover) {
  models::Scene scene = sample();
  using Extent = models::PlaceName::Extent;
  scene.names = {
      {"<b>gate</b>", "It is \"locked\".", {0.01, -0.02}},
      {"\xd7\x91\xd7\x99\xd7\xaa", {}, {0.0, 0.0}, Extent::area, {{0.0, 0.0}, {0.01, 0.0}, {0.0, 0.01}}},
      {"lake", {}, {0.02, 0.0}, Extent::label, {}}};
  EXPECT_EQ(decode_scene(*encode_scene(scene))->scene.names, scene.names);
  scene.names[0].name = std::string(10000, 'x');
  EXPECT_FALSE(encode_scene(scene));
  scene.names[0].name = "two\nlines";
  EXPECT_FALSE(encode_scene(scene));
  scene.names.assign(models::kMaxPlaceNames + 1, {"well", {}, {}});
  EXPECT_FALSE(encode_scene(scene));
}

TEST(SceneFile, KeepsContoursAndTheirGroovesExactly) {
  Raster<models::BoundaryPixel> edges(12, 9);
  for (int x = 0; x < 12; ++x) edges(x, 4) = {0.5F, 0.01F * static_cast<float>(x)};
  auto map = models::BoundaryMap::from_edges(edges, 0.001, 2.5, {0.3, 0.125}, Work{});
  ASSERT_TRUE(map);
  models::Scene scene = sample();
  scene.model = std::make_shared<const models::Contours>(models::Contours{
      std::move(*map),
      std::make_shared<const models::Relief>(*models::Relief::from_samples(hills(24, 18), 0.0005))});
  const auto back = decode_scene(*encode_scene(scene));
  ASSERT_TRUE(back) << back.error().sentence();
  const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&back->scene.model);
  ASSERT_NE(contours, nullptr);
  EXPECT_EQ((*contours)->boundaries.edges(), edges);
  EXPECT_EQ((*contours)->boundaries.radius_px(), 2.5);
  EXPECT_EQ((*contours)->boundaries.origin().threshold, 0.3);
  EXPECT_EQ((*contours)->boundaries.origin().boundary_fraction, 0.125);
  EXPECT_EQ((*contours)->grooves->samples_m(), hills(24, 18));
}

/// A field of two root cells, one of them subdivided, with a plane that two leaves share, an edge and a
/// curved leaf.
models::Scene field_scene() {
  const auto w = [](float v) { return std::bit_cast<std::uint32_t>(v); };
  constexpr std::uint32_t kLeaf = models::FieldTree::kLeaf;
  models::FieldTree tree;
  tree.words = {
      0U,         w(0), w(0), w(1), w(-0.004F), 1U, w(0.7071068F), w(0.7071068F), w(0),        w(0), w(1),
      w(-0.004F), w(1), w(0), w(0), w(-0.005F), 4U, w(0.5F),       0x10002000U,   0x30004000U, 0U,   0xFFF0U,
      7U};
  models::set_half_angles(&tree.words[5]);
  tree.nodes = {kLeaf, kLeaf | 5U, kLeaf, kLeaf | 16U, kLeaf, kLeaf, kLeaf | 5U, kLeaf};
  tree.roots = {0U, kLeaf};
  auto distance = models::DistanceField::from_tree({{-0.008, -0.004, 0.0}, 0.001, 3, {2, 1, 1}}, tree,
                                                   {1e-5, 2e-5, 3e-5});
  models::Scene scene = sample();
  scene.model = std::make_shared<const models::Field>(
      *models::field_of(*std::move(distance), {-0.005, -0.003, 0.001}, {0.005, 0.003, 0.004}));
  return scene;
}

models::Scene dense_scene(models::DenseContent content) {
  const models::Lattice lattice{{-0.004, -0.003, 0.0}, 0.001, {9, 7, 5}};
  std::vector<float> values;
  for (std::size_t i = 0; i < lattice.places() * models::floats_of(content); ++i)
    values.push_back(0.001F * std::sin(0.37F * static_cast<float>(i)));
  auto dense = models::DenseField::from(lattice, content, std::move(values), {0.0, 2e-5, 3e-5});
  models::Scene scene = sample();
  scene.model = std::make_shared<const models::FieldOnLattice>(
      *models::field_of(*std::move(dense), {-0.003, -0.002, 0.001}, {0.003, 0.002, 0.003}));
  return scene;
}

TEST(SceneFile, KeepsHowASolidLies) {
  models::Scene scene = field_scene();
  EXPECT_EQ(decode_scene(*encode_scene(scene))->scene.pose, models::SolidPose::upright);
  scene.pose = models::SolidPose::flat;
  EXPECT_EQ(decode_scene(*encode_scene(scene))->scene.pose, models::SolidPose::flat);
}

TEST(SceneFile, KeepsADenseFieldBitByBit) {
  for (const auto content : {models::DenseContent::distance, models::DenseContent::distance_and_force}) {
    const models::Scene scene = dense_scene(content);
    const auto back = decode_scene(*encode_scene(scene));
    ASSERT_TRUE(back) << back.error().sentence();
    EXPECT_TRUE(back->others.empty());
    const auto& before = *std::get<std::shared_ptr<const models::FieldOnLattice>>(scene.model);
    const auto& after = *std::get<std::shared_ptr<const models::FieldOnLattice>>(back->scene.model);
    EXPECT_EQ(after.distance.content(), content);
    EXPECT_EQ(after.distance.values(), before.distance.values());
    EXPECT_EQ(after.distance.lattice().origin_m, before.distance.lattice().origin_m);
    EXPECT_EQ(after.distance.errors().max_m, 3e-5);
    EXPECT_EQ(after.least_m, before.least_m);
    EXPECT_EQ(after.from_above->samples_m(), before.from_above->samples_m());
  }
}

TEST(SceneFile, RefusesADenseFieldOfAnotherSizeThanItStates) {
  auto members = unzip(*encode_scene(dense_scene(models::DenseContent::distance)));
  ASSERT_TRUE(members);
  auto description = nlohmann::json::parse(as_text(members->at("scene.json")));
  for (const nlohmann::json& counts :
       {nlohmann::json{9, 7, 6}, nlohmann::json{1 << 19, 1 << 19, 1 << 19}, nlohmann::json{9, 7, 0}}) {
    description["model"]["counts"] = counts;
    const std::string text = description.dump();
    const auto bytes = std::as_bytes(std::span(text));
    (*members)["scene.json"] = Bytes(bytes.begin(), bytes.end());
    EXPECT_FALSE(decode_scene(*zip(*members))) << counts;
  }
}

TEST(SceneFile, KeepsAFieldsDistancesExactly) {
  const models::Scene scene = field_scene();
  const auto back = decode_scene(*encode_scene(scene));
  ASSERT_TRUE(back) << back.error().sentence();
  const auto& before = *std::get<std::shared_ptr<const models::Field>>(scene.model);
  const auto& after = *std::get<std::shared_ptr<const models::Field>>(back->scene.model);
  EXPECT_EQ(after.distance.leaves(), before.distance.leaves());
  EXPECT_EQ(after.distance.memory_bytes(), before.distance.memory_bytes());
  EXPECT_EQ(after.distance.errors().max_m, 3e-5);
  EXPECT_EQ(after.most_m, before.most_m);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{-0.008 + 0.016 * (i % 10) / 9.0, -0.004 + 0.008 * (i / 10 % 10) / 9.0,
                 0.008 * (i / 100) / 9.0};
    ASSERT_EQ(after.distance.sample({p}).distance_m, before.distance.sample({p}).distance_m);
    ASSERT_EQ(after.distance.sample({p}).gradient, before.distance.sample({p}).gradient);
  }
}

TEST(SceneFile, RefusesADamagedFieldOrReadsAValidOne) {
  const auto members = unzip(*encode_scene(field_scene()));
  ASSERT_TRUE(members);
  const Bytes& valid = members->at("cells.field.zst");
  int refused = 0;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    ZipMembers damaged = *members;
    damaged.at("cells.field.zst")[i] ^= static_cast<std::byte>(1U << (i % 8));
    const auto scene = decode_scene(*zip(damaged));
    refused += scene ? 0 : 1;
  }
  EXPECT_GT(refused, static_cast<int>(valid.size() / 3));
  ZipMembers cut = *members;
  cut.at("cells.field.zst").resize(valid.size() / 2);
  EXPECT_FALSE(decode_scene(*zip(cut)));
}

TEST(SceneFile, IsDeterministic) { EXPECT_EQ(*encode_scene(sample()), *encode_scene(sample())); }

TEST(SceneFile, KeepsMembersThatItDoesNotKnow) {
  const ZipMembers others{{"notes.txt", Bytes(5, std::byte{'x'})}};
  const auto first = decode_scene(*encode_scene(sample(), others));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->others, others);
  EXPECT_EQ(decode_scene(*encode_scene(first->scene, first->others))->others, others);
}

TEST(SceneFile, IsNotWrittenWithoutMaterialsOrWithUnknownLabels) {
  models::Scene scene = sample();
  scene.labels(0, 0) = 2;
  EXPECT_FALSE(encode_scene(scene));
  scene.labels = {};
  EXPECT_TRUE(encode_scene(scene));
  scene.materials.clear();
  EXPECT_FALSE(encode_scene(scene));
}

TEST(FloatBlock, KeepsEveryBitPatternAndCompressesSmoothRows) {
  using Limits = std::numeric_limits<float>;
  const std::vector<float> odd{0.0F,
                               -0.0F,
                               1.0F,
                               -1.0F,
                               Limits::infinity(),
                               -Limits::infinity(),
                               Limits::quiet_NaN(),
                               Limits::denorm_min(),
                               Limits::max(),
                               Limits::lowest(),
                               3.0F,
                               4.0F};
  const auto packed = pack_floats(odd, 4);
  const auto back = unpack_floats(*packed, odd.size(), 4);
  ASSERT_TRUE(back);
  EXPECT_EQ(std::memcmp(back->data(), odd.data(), 4 * odd.size()), 0);
  EXPECT_FALSE(unpack_floats(*packed, odd.size() + 1, 4));
  EXPECT_FALSE(unpack_floats(std::span(*packed).first(packed->size() - 1), odd.size(), 4));

  const Raster<float> smooth = hills(640, 480);
  EXPECT_LT(pack_floats(smooth.values(), 640)->size(), 4 * smooth.count() * 2 / 3);
}

}  // namespace
}  // namespace palpable::formats
