// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/recent_scenes.hpp"

#include "palpable/page/shelf/scene_card.hpp"
#include "palpable/page/shelf/test_programs.hpp"

#include <fstream>
#include <thread>

namespace palpable::page::shelf {
namespace {

namespace fs = std::filesystem;

std::string added(RecentScenes& recent, const fs::path& folder, const std::string& title,
                  std::size_t bytes = 10) {
  std::ofstream(folder / "made.palp") << std::string(bytes, 'x');
  const auto id = recent.add(folder / "made.palp", {title, "a relief", "Words."}, Raster<Rgb8>(4, 3));
  // Their order is that of their files' times.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return id ? *id : std::string();
}

std::vector<std::string> titles_of(const RecentScenes& recent) {
  std::vector<std::string> titles;
  for (const auto& one : recent.list()) titles.push_back(one.card.title);
  return titles;
}

using Titles = std::vector<std::string>;

TEST(RecentScenes, ArePrivateAndTheNewestIsFirst) {
  const auto folder = new_folder("recent");
  RecentScenes recent(folder / "state" / "scenes", folder);
  const std::string first = added(recent, folder, "first");
  const std::string second = added(recent, folder, "second");
  EXPECT_EQ(titles_of(recent), (Titles{"second", "first"}));
  recent.note_opened(first);
  EXPECT_EQ(titles_of(recent), (Titles{"first", "second"}));
  const auto others = fs::perms::group_all | fs::perms::others_all;
  EXPECT_EQ(fs::status(folder / "state" / "scenes").permissions() & others, fs::perms::none);
  EXPECT_EQ(fs::status(*recent.scene(first)).permissions() & others, fs::perms::none);
  EXPECT_EQ(fs::status(*recent.picture(first)).permissions() & others, fs::perms::none);
  // Another program sees the same.
  EXPECT_EQ(titles_of(RecentScenes(folder / "state" / "scenes", folder)), (Titles{"first", "second"}));
  recent.forget(second);
  EXPECT_EQ(titles_of(recent), Titles{"first"});
  recent.forget_all();
  EXPECT_TRUE(fs::is_empty(folder / "state" / "scenes"));
}

TEST(RecentScenes, SayWhetherTheirFolderCanBeUsed) {
  const auto folder = new_folder("recent");
  EXPECT_TRUE(RecentScenes(folder / "scenes", folder).are_lasting());
  std::ofstream(folder / "file") << "a file where the folder should be";
  RecentScenes instead(folder / "file", folder);
  EXPECT_FALSE(instead.are_lasting());
  EXPECT_FALSE(RecentScenes({}, folder).are_lasting());
  EXPECT_FALSE(added(instead, folder, "kept all the same").empty());
}

TEST(RecentScenes, AreBounded) {
  const auto folder = new_folder("recent");
  RecentScenes recent(folder / "scenes", folder, {.most_scenes = 3, .most_bytes = 1000});
  for (const char* const title : {"1", "2", "3", "4"}) added(recent, folder, title);
  EXPECT_EQ(titles_of(recent), (Titles{"4", "3", "2"}));
  added(recent, folder, "large", 990);
  EXPECT_EQ(titles_of(recent), (Titles{"large", "4"}));
  added(recent, folder, "too large", 2000);
  EXPECT_EQ(titles_of(recent), Titles{"too large"}) << "it is being touched";
}

TEST(RecentScenes, RefuseNamesThatAreNoIds) {
  const auto folder = new_folder("recent");
  RecentScenes recent(folder / "scenes", folder);
  std::ofstream(folder / "secret.palp") << "secret";
  const std::string id = added(recent, folder, "one");
  for (const std::string& name :
       {std::string("../secret"), std::string(), std::string(32, '/'), id + "0", id.substr(1) + "A"}) {
    EXPECT_FALSE(recent.scene(name)) << name;
    EXPECT_FALSE(recent.picture(name)) << name;
    recent.forget(name);
  }
  EXPECT_TRUE(fs::exists(folder / "secret.palp"));
  EXPECT_EQ(titles_of(recent), Titles{"one"});
}

TEST(RecentScenes, LeaveOutWhatIsDamaged) {
  const auto folder = new_folder("recent");
  RecentScenes recent(folder / "scenes", folder);
  const std::string id = added(recent, folder, "one");
  std::ofstream(folder / "scenes" / (id + ".json")) << std::string(100000, '[');
  EXPECT_TRUE(recent.list().empty());
}

TEST(RecentScenes, LeaveOutLinksAndAFolderThatIsALink) {
  const auto folder = new_folder("recent");
  RecentScenes recent(folder / "scenes", folder);
  const std::string id = added(recent, folder, "one");
  std::ofstream(folder / "secret") << "secret";
  const fs::path picture = folder / "scenes" / (id + ".png"), scene = folder / "scenes" / (id + ".palp");
  fs::remove(picture);
  fs::create_symlink(folder / "secret", picture);
  EXPECT_FALSE(recent.picture(id));
  fs::rename(scene, folder / "moved.palp");
  fs::create_symlink(folder / "moved.palp", scene);
  EXPECT_FALSE(recent.scene(id));
  EXPECT_TRUE(recent.list().empty());

  fs::create_directory(folder / "foreign");
  fs::permissions(folder / "foreign", fs::perms::all);
  fs::create_directory_symlink(folder / "foreign", folder / "link");
  const RecentScenes linked(folder / "link", folder);
  EXPECT_EQ(fs::status(folder / "foreign").permissions(), fs::perms::all);
}

TEST(RecentScenes, UseAnotherFolderWhereTheFirstCannotBeMade) {
  const auto folder = new_folder("recent");
  std::ofstream(folder / "file") << "no folder";
  RecentScenes recent(folder / "file" / "scenes", folder);
  added(recent, folder, "one");
  EXPECT_EQ(titles_of(recent), Titles{"one"});
}

TEST(SceneCard, SaysWhatTheMakerSays) {
  models::Scene scene = test_scene();
  scene.description = "A level plate. " + std::string(1000, 'x');
  const SceneCard card = scene_card(scene);
  EXPECT_EQ(card.title, "A level");
  EXPECT_EQ(card.kind, "a relief");
  EXPECT_EQ(card.sentence, "A level plate.");
  scene.description.clear();
  EXPECT_FALSE(scene_card(scene).sentence.empty());
  const auto picture = scene_picture(scene, 100);
  EXPECT_EQ(picture.width(), 100);
  EXPECT_EQ(picture.height(), 75);
  EXPECT_EQ(picture(50, 37).r, 201) << "a level surface keeps its colours";
}

}  // namespace
}  // namespace palpable::page::shelf
