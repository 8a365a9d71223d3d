// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/key_names.hpp"

#include "palpable/formats/scene/scene_file.hpp"

#include <filesystem>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class NamesByKeys : public testing::Test {
 protected:
  NamesByKeys() {
    std::filesystem::create_directories(folder);
    models::Scene plate;
    plate.model = std::make_shared<const models::Relief>(
        *models::Relief::from_samples(Raster<float>(100, 100, 0.001F), 0.001));
    touched = std::make_shared<const models::Scene>(std::move(plate));
  }
  ~NamesByKeys() override { std::filesystem::remove_all(folder); }
  const models::Scene& scene() { return *(now = names.named(touched)); }

  std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("key-names-" + std::to_string(getpid()));
  std::filesystem::path file = folder / "plate.palp";
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
  EXPECT_THAT(names.save(scene()), EndsWith("plate.palp."));
  const auto saved = formats::read_scene(file);
  ASSERT_TRUE(saved);
  EXPECT_EQ(saved->scene.names, scene().names);
  EXPECT_EQ(names.unsaved_words(), "");
}

TEST_F(NamesByKeys, AreKeptBesideTheSceneUntilTheyAreSaved) {
  names.name(scene(), {0.01, 0.0}, "well");
  names.name(scene(), {0.02, 0.0}, "gate");
  EXPECT_THAT(names.unsaved_words(), EndsWith("plate-unsaved.palp."));
  const auto kept = formats::read_scene(folder / "plate-unsaved.palp");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->scene.names, scene().names);
  EXPECT_THAT(KeyNames(file).left_over_words(), EndsWith("plate-unsaved.palp."));
  names.undo(scene());
  names.undo(scene());
  EXPECT_EQ(names.unsaved_words(), "") << "all is undone";
  names.name(scene(), {0.01, 0.0}, "well");
  EXPECT_THAT(names.unsaved_words(), EndsWith("plate-unsaved.palp."));
  names.save(scene());
  EXPECT_FALSE(std::filesystem::exists(folder / "plate-unsaved.palp"));
}

TEST_F(NamesByKeys, SayWhenTheyAreLost) {
  EXPECT_TRUE(names.none_lost());
  std::filesystem::remove_all(folder);
  EXPECT_THAT(names.name(scene(), {0.01, 0.0}, "well"), HasSubstr("lost at the end"));
  EXPECT_FALSE(names.none_lost());
  EXPECT_THAT(names.save(scene()), Not(StartsWith("The scene is saved")));
  EXPECT_FALSE(names.none_lost());
  std::filesystem::create_directories(folder);
  EXPECT_THAT(names.save(scene()), StartsWith("The scene is saved"));
  EXPECT_TRUE(names.none_lost());
}

}  // namespace
}  // namespace palpable::cli
