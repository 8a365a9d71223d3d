// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Files that are no scenes, damaged, or of another version.
#include "palpable/formats/scene/test_scene_file.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

TEST(RefusedScenes, RefusesANewerMajorVersionAndReadsANewerMinorOne) {
  const auto newer = decode_scene(with_description("\"major\": 1", "\"major\": 2"));
  ASSERT_FALSE(newer);
  EXPECT_EQ(newer.error().code, ErrorCode::invalid_input);
  EXPECT_NE(newer.error().message.find("format version 2.0"), std::string::npos) << newer.error().message;
  const auto minor = decode_scene(with_description("\"minor\": 0", "\"minor\": 7, \"later\": [1]"));
  ASSERT_TRUE(minor) << minor.error().message;
  EXPECT_EQ(minor->version, "1.7");
}

TEST(RefusedScenes, RefusesInvalidDescriptionsWithASentence) {
  const struct {
    const char* from;
    const char* to;
    const char* says;
  } kCases[] = {
      {"\"kind\": \"relief\"", "\"kind\": \"cloud\"", "kind 'cloud'"},
      {"\"columns\": 40", "\"columns\": 20000000", "states a size of 20000000 x 30"},
      {"\"columns\": 40", "\"columns\": -4", "states a size"},
      {"\"columns\": 40", "\"columns\": 41", "damaged"},
      {"\"columns\": 40", "\"columns\": \"x\"", "scene.json that is damaged"},
      {"\"pixel_m\": 0.0025", "\"pixel_m\": -1", ""},
      {"heights.f32.zst", "elsewhere", "lacks the heights"},
      {"\"texture\": \"texture.png\"", "\"texture\": \"nowhere.png\"", "lacks its member nowhere.png"},
      {"\"texture\": \"texture.png\"", "\"texture\": \"heights.f32.zst\"", "its picture is a PNG"},
      {"\"stiffness_N_per_m\": 900.0", "\"stiffness_N_per_m\": -1", "negative"},
      {"\"stiffness_N_per_m\": 900.0", "\"stiffness_N_per_m\": null", "damaged"},
      {"\"scale\": 0.0001", "\"scale\": 0", "place in its input"},
      {"\"format\": \"palpable-scene\"", "\"format\": \"other\"", "not a Palpable scene"},
      {"\"source\"", "\"sauce\"", "damaged or incomplete"}};
  for (const auto& c : kCases) {
    const auto scene = decode_scene(with_description(c.from, c.to));
    ASSERT_FALSE(scene) << c.to;
    EXPECT_NE(scene.error().message.find(c.says), std::string::npos) << c.to << ": " << scene.error().message;
  }
}

TEST(RefusedScenes, RefusesValuesThatAreFarTooLarge) {
  const struct {
    const char* from;
    const char* to;
    const char* says;
  } kCases[] = {
      {"\"minor\": 0", "\"minor\": -80", "impossible format version 1.-80"},
      {"\"size_m\": [", "\"size_m\": [], \"other\": [", "not three lengths"},
      {"\"size_m\": [", "\"size_m\": [\"1\",", "not three lengths"},
      {"\"size_m\": [", "\"size_m\": [9, 9, 9], \"other\": [", "does not have the size that it states"},
      {"\"stiffness_N_per_m\": 900.0", "\"stiffness_N_per_m\": 1e308", "stiffness"},
      {"\"damping_Ns_per_m\": 1.0", "\"damping_Ns_per_m\": 1e300", "damping"},
      {"\"static_friction\": 0.5", "\"static_friction\": 9e15", "friction"},
      {"\"dynamic_friction\": 0.4", "\"dynamic_friction\": 10.1", "friction"},
      {"\"scale\": ", "\"scale\": 1e308, \"other\": ", "place in its input"}};
  for (const auto& c : kCases) {
    const auto scene = decode_scene(with_description(c.from, c.to));
    ASSERT_FALSE(scene) << c.to;
    EXPECT_NE(scene.error().message.find(c.says), std::string::npos) << c.to << ": " << scene.error().message;
  }
  models::Scene scene = sample();
  scene.scene_from_input.rotation[4] = 1e308;
  EXPECT_FALSE(encode_scene(scene));
}

TEST(RefusedScenes, RefusesADamagedFileOrReadsTheSameScene) {
  const auto file = *encode_scene(sample());
  const Raster<float> good = hills(40, 30);
  for (std::size_t length = 0; length < file.size(); length += 7)
    EXPECT_FALSE(decode_scene(std::span(file).first(length))) << length;
  int refused = 0;
  for (std::size_t i = 0; i < file.size(); i += 3) {
    auto changed = file;
    changed[i] ^= std::byte{0x55};
    const auto scene = decode_scene(changed);
    refused += scene ? 0 : 1;
    // The archive's dates and flags may change; checksums protect the heights.
    if (scene) {
      EXPECT_EQ(std::get<std::shared_ptr<const models::Relief>>(scene->scene.model)->samples_m(), good) << i;
    }
  }
  EXPECT_GT(refused, static_cast<int>(file.size() / 3 / 2));
}

TEST(RefusedScenes, RefusesOtherFiles) {
  EXPECT_FALSE(decode_scene({}));
  EXPECT_FALSE(decode_scene(as_bytes("just a text")));
  EXPECT_NE(decode_scene(*zip({{"a", {}}})).error().message.find("without scene.json"), std::string::npos);
  EXPECT_FALSE(read_scene("/no/such/scene.palp"));
}

}  // namespace
}  // namespace palpable::formats
