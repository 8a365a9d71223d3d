// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/scene_bytes.hpp"

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/onefile/test_scenes.hpp"

#include <random>

#include <gtest/gtest.h>

namespace palpable::onefile {
namespace {

TEST(SceneBytes, KeepEveryKindOfSceneBitByBit) {
  for (const models::Scene& scene : scenes_of_all_kinds()) {
    const auto bytes = encode_scene_bytes(scene);
    const auto back = decode_scene_bytes(bytes);
    ASSERT_TRUE(back) << models::kind_of(scene.model) << ": " << back.error().sentence();
    EXPECT_EQ(encode_scene_bytes(*back), bytes) << models::kind_of(scene.model);
    EXPECT_EQ(models::relief_of(*back)->samples_m(), models::relief_of(scene)->samples_m());
  }
}

TEST(SceneBytes, KeepWordsMaterialsAndTheMap) {
  const models::Scene scene = map_scene();
  const auto back = decode_scene_bytes(encode_scene_bytes(scene));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->title, scene.title);
  EXPECT_EQ(back->description, scene.description);
  EXPECT_EQ(back->warnings, scene.warnings);
  ASSERT_EQ(back->names.size(), 1U);
  EXPECT_EQ(back->names, scene.names);
  EXPECT_EQ(back->source.inputs, scene.source.inputs);
  EXPECT_EQ(back->labels, scene.labels);
  EXPECT_EQ(back->materials[1].name, "stone <wall>");
  EXPECT_EQ(back->materials[1].texture, scene.materials[1].texture);
  EXPECT_EQ(back->scene_from_input.scale, 0.25);
  ASSERT_NE(back->map, nullptr);
  EXPECT_EQ(back->map->streets[0].name, "Große Straße");
  EXPECT_EQ(back->map->streets[0].kind, MapStreet::Kind::steps);
  EXPECT_TRUE(back->map->places[0].tactile_paving);
  // The picture goes beside the bytes.
  EXPECT_TRUE(back->texture.empty());
}

TEST(SceneBytes, OfACutFileAreRefused) {
  for (const models::Scene& scene : scenes_of_all_kinds()) {
    const auto bytes = encode_scene_bytes(scene);
    const std::size_t step = bytes.size() / 60 + 1;
    for (std::size_t size = 0; size < bytes.size(); size += step)
      EXPECT_FALSE(decode_scene_bytes(std::span(bytes).first(size))) << size << " of " << bytes.size();
  }
}

TEST(SceneBytes, WithOtherBytesAreReadOrRefusedWithoutHarm) {
  std::mt19937 random(7);
  int refused = 0;
  for (const models::Scene& scene : scenes_of_all_kinds()) {
    const auto bytes = encode_scene_bytes(scene);
    for (int round = 0; round < 15; ++round) {
      auto changed = bytes;
      for (int k = 0; k < 4; ++k) changed[random() % changed.size()] = static_cast<std::byte>(random());
      refused += decode_scene_bytes(changed) ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace palpable::onefile
