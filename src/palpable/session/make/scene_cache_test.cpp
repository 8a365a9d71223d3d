// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/scene_cache.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/session/make/make_scene.hpp"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;

class SceneCacheTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "palpable-cache-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a test");
    folder_ = name;
    std::ofstream(folder_ / "box.obj") << "v 0 0 0\nv 0.05 0 0\nv 0 0.05 0\nv 0 0 0.05\n"
                                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    options_.input.files = {folder_ / "box.obj"};
    options_.recipes.field.field.resolution = 32;
    options_.made_by = "test";
    options_.cache.folder = folder_ / "cache";
  }
  void TearDown() override { fs::remove_all(folder_); }

  recipes::MadeScene made() const {
    auto made = make_scene(options_, {});
    if (!made) throw std::runtime_error(made.error().sentence());
    return std::move(*made);
  }
  static bool was_cached(const recipes::MadeScene& made) {
    for (const Note& note : made.notes)
      if (note.sentence.find("cache") != std::string::npos) return true;
    return false;
  }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> paths;
    if (!fs::exists(options_.cache.folder)) return paths;
    for (const auto& entry : fs::directory_iterator(options_.cache.folder)) paths.push_back(entry.path());
    return paths;
  }

  fs::path folder_;
  MakeOptions options_;
};

TEST_F(SceneCacheTest, GivesTheSameSceneTheSecondTime) {
  const auto first = made(), second = made();
  EXPECT_FALSE(was_cached(first));
  EXPECT_TRUE(was_cached(second));
  EXPECT_EQ(*formats::encode_scene(first.scene), *formats::encode_scene(second.scene));
  // The notes from making the scene, and the note about the cache.
  ASSERT_EQ(second.notes.size(), first.notes.size() + 1);
  EXPECT_EQ(second.notes.front(), first.notes.front());
  EXPECT_EQ(entries().size(), 1U);
}

TEST_F(SceneCacheTest, KnowsAFileByItsContent) {
  static_cast<void>(made());
  fs::copy_file(folder_ / "box.obj", folder_ / "copy.obj");
  options_.input.files = {folder_ / "copy.obj"};
  const auto copy = made();
  EXPECT_TRUE(was_cached(copy));
  EXPECT_EQ(copy.scene.source.inputs.front(), (folder_ / "copy.obj").string());
  std::ofstream(folder_ / "copy.obj", std::ios::app) << "v 0.01 0.01 -0.02\nf 1 3 5\nf 3 2 5\nf 2 1 5\n";
  EXPECT_FALSE(was_cached(made()));
}

TEST_F(SceneCacheTest, MakesASceneAnewForOtherOptions) {
  static_cast<void>(made());
  options_.recipes.field.field.resolution = 48;
  EXPECT_FALSE(was_cached(made()));
  options_.recipes.field.field.max_error_m = 1e-4;
  EXPECT_FALSE(was_cached(made()));
  options_.recipes.field.placement.size_m = Vec3{0.08, 0.08, 0.08};
  EXPECT_FALSE(was_cached(made()));
  options_.made_by = "a newer version";
  EXPECT_FALSE(was_cached(made()));
  EXPECT_EQ(entries().size(), 5U);
}

TEST_F(SceneCacheTest, ReplacesADamagedEntry) {
  static_cast<void>(made());
  const fs::path entry = entries().at(0);
  fs::resize_file(entry, fs::file_size(entry) / 2);
  EXPECT_FALSE(was_cached(made()));
  EXPECT_TRUE(was_cached(made()));
  std::ofstream(entry) << "no scene";
  EXPECT_FALSE(was_cached(made()));
  EXPECT_TRUE(was_cached(made()));
  // A complete scene with another key is not accepted either.
  ASSERT_TRUE(formats::write_scene(entry, made().scene));
  EXPECT_FALSE(was_cached(made()));
}

TEST_F(SceneCacheTest, ReplacesAnEntryWhoseMemberIsOfAnotherForm) {
  const models::Scene scene = made().scene;
  const fs::path entry = entries().at(0);
  for (const std::string member : {"{\"key\": 7, \"notes\": []}", "{\"notes\": 1}", "[]", "{"}) {
    const auto bytes = std::as_bytes(std::span(member));
    const auto file = formats::encode_scene(scene, {{"cache.json", {bytes.begin(), bytes.end()}}});
    ASSERT_TRUE(file);
    ASSERT_TRUE(write_file_atomically(entry, *file));
    EXPECT_FALSE(was_cached(made())) << member;
  }
}

TEST_F(SceneCacheTest, RemovesWhatWasUsedLeastRecently) {
  const auto made_at = [&](int resolution) {
    options_.recipes.field.field.resolution = resolution;
    return was_cached(made());
  };
  static_cast<void>(made_at(48));
  const fs::path first = entries().at(0);
  fs::last_write_time(first, fs::file_time_type::clock::now() - std::chrono::hours(2));
  static_cast<void>(made_at(49));
  const auto all = entries();
  const fs::path second = all.at(0) == first ? all.at(1) : all.at(0);
  fs::last_write_time(second, fs::file_time_type::clock::now() - std::chrono::hours(1));
  // The first one is used again, so it is not the one that is removed.
  EXPECT_TRUE(made_at(48));
  options_.cache.most_bytes = fs::file_size(first) + fs::file_size(second) + 100;
  EXPECT_FALSE(made_at(20));
  EXPECT_TRUE(fs::exists(first));
  EXPECT_FALSE(fs::exists(second));
  EXPECT_EQ(entries().size(), 2U);
  // A larger scene than the limit is not stored, and nothing is removed for it.
  options_.cache.most_bytes = 10;
  EXPECT_FALSE(made_at(51));
  EXPECT_EQ(entries().size(), 2U);
  // A limit of 0 also uses none.
  EXPECT_TRUE(made_at(48));
  options_.cache.most_bytes = 0;
  EXPECT_FALSE(made_at(48));
}

TEST_F(SceneCacheTest, MakesTheSceneWhereTheCacheCannotBeWrittenOrIsOff) {
  std::ofstream(folder_ / "file") << "no folder";
  options_.cache.folder = folder_ / "file" / "cache";
  EXPECT_FALSE(was_cached(made()));
  EXPECT_FALSE(was_cached(made()));
  options_.cache.folder.clear();
  EXPECT_FALSE(was_cached(made()));
  EXPECT_TRUE(entries().empty());
}

TEST_F(SceneCacheTest, GivesATouchTheFineFieldAtOnce) {
  options_.recipes.field.field.resolution = 64;
  options_.coarse_field = {.resolution = 16, .max_error_m = 1e-3, .least_triangles = 1};
  int scenes = 0;
  const TakeScene take = [&](const recipes::MadeScene&) { ++scenes; };
  ASSERT_TRUE(make_scenes(options_, take, {}));
  EXPECT_EQ(scenes, 2);
  scenes = 0;
  ASSERT_TRUE(make_scenes(options_, take, {}));
  EXPECT_EQ(scenes, 1);
}

TEST_F(SceneCacheTest, TakesAsMuchAsTheUserAllows) {
  ASSERT_EQ(unsetenv("PALPABLE_CACHE_MB"), 0);
  EXPECT_EQ(user_cache_limit().bytes, SceneCache{}.most_bytes);
  for (const auto& [text, bytes] : {std::pair{"100", 100'000'000U}, std::pair{"0", 0U}}) {
    ASSERT_EQ(setenv("PALPABLE_CACHE_MB", text, 1), 0);
    EXPECT_EQ(user_cache_limit().bytes, bytes);
    EXPECT_FALSE(user_cache_limit().note) << text;
  }
  for (const char* const text : {"much", "-1", "100 MB", "99999999999999"}) {
    ASSERT_EQ(setenv("PALPABLE_CACHE_MB", text, 1), 0);
    EXPECT_EQ(user_cache_limit().bytes, SceneCache{}.most_bytes) << text;
    const auto note = user_cache_limit().note;
    ASSERT_TRUE(note) << text;
    EXPECT_NE(note->sentence.find("PALPABLE_CACHE_MB"), std::string::npos) << note->sentence;
    EXPECT_NE(note->sentence.find("512 MiB"), std::string::npos) << note->sentence;
  }
  ASSERT_EQ(setenv("PALPABLE_CACHE_MB", "", 1), 0);
  EXPECT_EQ(user_cache_limit().bytes, SceneCache{}.most_bytes);
  EXPECT_FALSE(user_cache_limit().note);
}

TEST_F(SceneCacheTest, LiesInTheFolderThatTheDesktopStandardNames) {
  ASSERT_EQ(setenv("XDG_CACHE_HOME", "/somewhere", 1), 0);
  EXPECT_EQ(user_cache_folder(), "/somewhere/palpable/scenes");
  // A relative path must be ignored.
  ASSERT_EQ(setenv("XDG_CACHE_HOME", "somewhere", 1), 0);
  ASSERT_EQ(setenv("HOME", "/home/anna", 1), 0);
  EXPECT_EQ(user_cache_folder(), "/home/anna/.cache/palpable/scenes");
  ASSERT_EQ(unsetenv("HOME"), 0);
  EXPECT_TRUE(user_cache_folder().empty());
}

}  // namespace
}  // namespace palpable::session
