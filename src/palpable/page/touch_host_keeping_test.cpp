// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a page's host keeps and saves, and what it says of a scene.
#include "palpable/describe/language.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/page/test_host_on_a_touch.hpp"

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

TEST_F(HostOnATouch, KeepsNamesBesideTheSceneUntilTheyAreSaved) {
  const auto copy = file.parent_path() / (file.stem().string() + "-unsaved.palp");
  std::filesystem::remove(copy);
  protocol::Name name;
  name.name = "summit";
  host->name(name);
  // It is empty for a moment.
  ASSERT_TRUE(comes_true([&] { return formats::read_scene(copy).has_value(); }));
  EXPECT_EQ(formats::read_scene(copy)->scene.names.front().name, "summit");
  host->save();
  EXPECT_TRUE(comes_true([&] { return !std::filesystem::exists(copy); }));
  EXPECT_EQ(formats::read_scene(file)->scene.names.front().name, "summit");
  std::filesystem::remove(file);
}

TEST_F(HostOnATouch, SaysWhatIsToBeKnownOfTheSceneOnce) {
  host.reset();
  auto options = options_for_host();
  options.notes = {"The shelf could not keep this scene: save it if you want to open it again"};
  host = std::make_unique<TouchHost>(*session, std::move(options));
  const describe::LanguageScope german(describe::Language::german);
  std::string said;
  while (const auto notice = host->next_notice()) said += notice->text;
  EXPECT_NE(said.find("Das Regal konnte diese Szene nicht behalten"), std::string::npos) << said;
  EXPECT_FALSE(host->next_notice());
}

TEST_F(HostOnATouch, KeepsNamesWhereItIsTold) {
  const auto copy = file.parent_path() / (file.stem().string() + "-unsaved.palp");
  std::filesystem::remove(copy);
  std::mutex mutex;
  std::string kept;
  bool can_keep = true;
  host.reset();
  auto options = options_for_host();
  options.keep = [&](const models::Scene& scene) -> Result<void> {
    const std::lock_guard lock(mutex);
    if (!can_keep) return Error{ErrorCode::failed, "no", {}};
    kept = scene.names.empty() ? "" : scene.names.back().name;
    return {};
  };
  const auto kept_now = [&] {
    const std::lock_guard lock(mutex);
    return std::exchange(kept, {});
  };
  host = std::make_unique<TouchHost>(*session, options);
  protocol::Name name;
  name.name = "summit";
  host->name(name);
  std::string said;
  EXPECT_TRUE(comes_true([&] {
    while (const auto notice = host->next_notice()) said += notice->text;
    return said.find("summit") != std::string::npos;
  }));
  EXPECT_EQ(kept_now(), "summit") << "it is kept before it is said to be named";
  EXPECT_FALSE(std::filesystem::exists(copy));
  better = cone_scene();
  EXPECT_TRUE(comes_true([&] { return kept_now() == "summit"; })) << "with the finer scene again";
  {
    const std::lock_guard lock(mutex);
    can_keep = false;
  }
  name.name = "slope";
  name.x_m = 0.005;
  host->name(name);
  EXPECT_TRUE(comes_true([&] { return formats::read_scene(copy).has_value(); })) << "nothing is lost";
  host.reset();
  std::filesystem::remove(copy);
}

TEST_F(HostOnATouch, SavesTheSceneWithItsEditedMaterials) {
  host->edit(edit(6, 320.0));
  host->save();
  std::optional<protocol::Notice> notice;
  EXPECT_TRUE(comes_true([&] { return (notice = host->next_notice()).has_value(); }));
  EXPECT_EQ(notice->text, "The scene is saved as " + file.string());
  const auto read = formats::read_scene(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->scene.materials.front().stiffness_N_per_m, 320.0);
  EXPECT_EQ(read->scene.materials.front().texture.kind, models::TouchTexture::Kind::ridges);
}

}  // namespace
}  // namespace palpable::page
