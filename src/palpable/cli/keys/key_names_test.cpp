// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/key_names.hpp"

#include "palpable/formats/scene/scene_file.hpp"

#include <filesystem>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class NamesByKeys : public testing::Test {
 protected:
  NamesByKeys() {
    models::Scene plate;
    plate.model = std::make_shared<const models::Relief>(
        *models::Relief::from_samples(Raster<float>(100, 100, 0.001F), 0.001));
    touched = std::make_shared<const models::Scene>(std::move(plate));
  }
  const models::Scene& scene() { return *(now = names.named(touched)); }

  std::filesystem::path file = std::filesystem::temp_directory_path() / "palpable-key-names.palp";
  KeyNames names{file};
  std::shared_ptr<const models::Scene> touched, now;
};

TEST_F(NamesByKeys, AreGivenListedFoundAndUndone) {
  EXPECT_EQ(names.name(scene(), {0.03, 0.0}, "gate: It is locked."), "Named: gate, middle right.");
  EXPECT_THAT(names.list(scene(), {}), HasSubstr("gate, 30 millimetres right"));
  EXPECT_EQ(names.way(scene(), {}), "") << "nothing is looked for";
  EXPECT_EQ(names.find(scene(), {}, "gat"), "Gate: 30 millimetres right.");
  EXPECT_EQ(names.way(scene(), {0.02, 0.0}), "Gate: 10 millimetres right.");
  EXPECT_EQ(names.way(scene(), {0.03, 0.001}), "Here: gate. It is locked.");
  EXPECT_EQ(names.way(scene(), {}), "") << "it was found";
  EXPECT_THAT(names.undo(scene()), StartsWith("Undone: naming gate"));
  EXPECT_THAT(names.find(scene(), {}, "gate"), StartsWith("Nothing here"));
}

TEST_F(NamesByKeys, AreRefusedWithASentence) {
  EXPECT_THAT(names.name(scene(), {}, std::string(10000, 'x')), HasSubstr("at most 400 bytes"));
  EXPECT_EQ(names.name(scene(), {}, ""), "Nothing is named.");
  EXPECT_TRUE(scene().names.empty());
}

TEST_F(NamesByKeys, AreSavedWithTheScene) {
  names.name(scene(), {0.01, 0.0}, "<i>well</i>");
  EXPECT_THAT(names.save(scene()), EndsWith("palpable-key-names.palp."));
  const auto saved = formats::read_scene(file);
  ASSERT_TRUE(saved);
  EXPECT_EQ(saved->scene.names, scene().names);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace palpable::cli
