// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/unsaved_scene.hpp"

#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/models/relief/relief.hpp"

#include <filesystem>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::formats {
namespace {

class Unsaved : public testing::Test {
 protected:
  Unsaved() {
    std::filesystem::create_directories(folder);
    scene.model = std::make_shared<const models::Relief>(
        *models::Relief::from_samples(Raster<float>(20, 20, 0.001F), 0.001));
  }
  ~Unsaved() override { std::filesystem::remove_all(folder); }
  models::Scene named(const char* name) {
    models::Scene copy = scene;
    copy.names.push_back({name, {}, {}});
    return copy;
  }

  std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("unsaved-" + std::to_string(getpid()));
  models::Scene scene;
};

TEST_F(Unsaved, KeepsTheLastChangesUntilTheyAreSaved) {
  UnsavedScene unsaved(folder / "hills.palp");
  EXPECT_TRUE(unsaved.file().empty());
  ASSERT_TRUE(unsaved.keep(named("gate")));
  ASSERT_TRUE(unsaved.keep(named("well")));
  EXPECT_EQ(unsaved.file(), folder / "hills-unsaved.palp");
  EXPECT_EQ(read_scene(unsaved.file())->scene.names.front().name, "well");
  unsaved.discard();
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  EXPECT_TRUE(unsaved.file().empty());
}

TEST_F(Unsaved, ReplacesNoFileOfAnEarlierTouch) {
  const auto earlier = folder / "hills-unsaved.palp";
  std::ofstream(earlier) << "earlier";
  UnsavedScene unsaved(folder / "hills.palp");
  ASSERT_TRUE(unsaved.keep(named("gate")));
  EXPECT_EQ(unsaved.file(), folder / "hills-unsaved-2.palp");
  EXPECT_EQ(std::filesystem::file_size(earlier), 7U);
}

TEST_F(Unsaved, TwoTouchesKeepTwoCopiesAndALaterOneFindsThem) {
  EXPECT_TRUE(UnsavedScene::of_earlier_touch(folder / "hills.palp").empty());
  UnsavedScene one(folder / "hills.palp"), other(folder / "hills.palp");
  ASSERT_TRUE(one.keep(named("gate")));
  ASSERT_TRUE(other.keep(named("well")));
  EXPECT_NE(one.file(), other.file());
  EXPECT_EQ(read_scene(one.file())->scene.names.front().name, "gate");
  EXPECT_EQ(UnsavedScene::of_earlier_touch(folder / "hills.palp"), one.file());
}

TEST_F(Unsaved, DoesNotReplaceWhatAnotherProgramSavedUnlessToldTwice) {
  const auto file = folder / "hills.palp";
  ASSERT_TRUE(write_scene(file, scene));
  UnsavedScene one(file), other(file);
  ASSERT_TRUE(one.keep(named("gate")));
  ASSERT_TRUE(other.save(named("well")));
  ASSERT_TRUE(other.save(named("pond"))) << "its own file is no other program's";
  const auto refused = one.save(named("gate"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().sentence(),
            file.string() + ": changed by another program meanwhile; save again to replace it");
  EXPECT_EQ(read_scene(file)->scene.names.front().name, "pond");
  EXPECT_TRUE(std::filesystem::exists(one.file()));
  ASSERT_TRUE(one.save(named("gate")));
  EXPECT_EQ(read_scene(file)->scene.names.front().name, "gate");
  EXPECT_TRUE(one.file().empty());
}

TEST_F(Unsaved, IsSavedWhereThereWasNoFileOrItWasRemoved) {
  const auto file = folder / "hills.palp";
  UnsavedScene unsaved(file);
  ASSERT_TRUE(unsaved.save(named("gate")));
  std::filesystem::remove(file);
  EXPECT_TRUE(unsaved.save(named("well")));
  UnsavedScene late(folder / "new.palp");
  ASSERT_TRUE(write_scene(folder / "new.palp", scene));
  EXPECT_FALSE(late.save(named("gate"))) << "another program wrote it meanwhile";
}

TEST_F(Unsaved, IsNotSavedIntoAPipe) {
  const auto file = folder / "hills.palp";
  UnsavedScene unsaved(file);
  ASSERT_TRUE(unsaved.keep(named("gate")));
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  for (int k = 0; k < 2; ++k) EXPECT_FALSE(unsaved.save(named("gate"))) << "it would wait for a reader";
  EXPECT_TRUE(std::filesystem::exists(unsaved.file()));
}

TEST_F(Unsaved, SaysOnceThatItCannotBeKept) {
  UnsavedScene unsaved(folder / "none" / "hills.palp");
  EXPECT_FALSE(unsaved.keep(named("gate")));
  EXPECT_TRUE(unsaved.keep(named("well")));
  EXPECT_TRUE(unsaved.file().empty());
}

}  // namespace
}  // namespace palpable::formats
