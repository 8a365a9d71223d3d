// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/scene_hash.hpp"

#include "palpable/formats/scene/scene_file.hpp"

#include <cmath>
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
