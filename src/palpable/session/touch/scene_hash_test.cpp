// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/scene_hash.hpp"

#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

models::Scene flat() {
  models::Scene scene;
  scene.model =
      std::make_shared<const models::Relief>(*models::Relief::from_samples(Raster<float>(16, 12), 0.001));
  return scene;
}

models::Scene with_texture(models::TouchTexture::Kind kind, double pitch_m) {
  models::Scene scene = flat();
  scene.materials.front().texture = {kind, pitch_m, 3e-5, 0.0};
  if (kind != models::TouchTexture::Kind::picture) return scene;
  for (int k = 0; k < models::kTextureSide * models::kTextureSide; ++k)
    scene.materials.front().texture.tile.push_back(std::sin(0.1F * static_cast<float>(k)));
  return scene;
}

/// A bumpy ball of 40 mm with 4 threads, whose branches are built at the same time.
models::Scene bumpy_ball() {
  constexpr int kRound = 48, kUp = 24;
  Mesh mesh;
  for (int j = 0; j <= kUp; ++j)
    for (int i = 0; i < kRound; ++i) {
      const double a = 2.0 * std::numbers::pi * i / kRound, b = std::numbers::pi * j / kUp;
      const double r_m = 0.02 + 0.002 * std::sin(5.0 * a) * std::sin(b) * std::sin(4.0 * b);
      mesh.vertices_m.push_back(
          {r_m * std::sin(b) * std::cos(a), r_m * std::sin(b) * std::sin(a), -r_m * std::cos(b)});
    }
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * kRound + i % kRound); };
  for (int j = 0; j < kUp; ++j)
    for (int i = 0; i < kRound; ++i) {
      if (j > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (j < kUp - 1) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  recipes::FieldRecipe recipe;
  recipe.field.resolution = 48;
  recipe.field.max_error_m = 1e-4;
  Work work;
  work.threads = 4;
  return recipes::field_from_mesh(std::move(mesh), recipe, work)->scene;
}

TEST(SceneHash, OfAFieldIsTheSameBeforeItIsSavedAndAfter) {
  const models::Scene made = bumpy_ball();
  const auto read = formats::decode_scene(*formats::encode_scene(made));
  ASSERT_TRUE(read);
  EXPECT_EQ(scene_hash(read->scene), scene_hash(made));
  EXPECT_EQ(shape_hash(read->scene), shape_hash(made));
  SceneHashes hashes;
  EXPECT_EQ(hashes.of(std::make_shared<const models::Scene>(made)).shape, shape_hash(made));
}

TEST(SceneHash, DistinguishesTextures) {
  using Kind = models::TouchTexture::Kind;
  EXPECT_NE(scene_hash(flat()), scene_hash(with_texture(Kind::grain, 0.002)));
  EXPECT_NE(scene_hash(with_texture(Kind::grain, 0.001)), scene_hash(with_texture(Kind::grain, 0.002)));
  EXPECT_NE(scene_hash(with_texture(Kind::grain, 0.002)), scene_hash(with_texture(Kind::bumps, 0.002)));
  models::Scene other = with_texture(Kind::picture, 0.002);
  other.materials.front().texture.tile[9] += 0.1F;
  EXPECT_NE(scene_hash(with_texture(Kind::picture, 0.002)), scene_hash(other));
}

TEST(SceneHash, IsTheSameOfASceneThatWasSavedAndReadAgain) {
  const models::Scene scene = with_texture(models::TouchTexture::Kind::picture, 0.002);
  const auto file = formats::encode_scene(scene);
  ASSERT_TRUE(file);
  const auto back = formats::decode_scene(*file);
  ASSERT_TRUE(back);
  EXPECT_EQ(scene_hash(back->scene), scene_hash(scene));
}

}  // namespace
}  // namespace palpable::session
