// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/touch_host.hpp"

#include "palpable/device/recording/recording.hpp"
#include "palpable/formats/scene/scene_file.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

// A cone of 10 mm in the middle of 40 x 30 mm.
std::shared_ptr<const models::Scene> cone_scene() {
  Raster<float> height_m(80, 60);
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 80; ++i)
      height_m(i, j) = static_cast<float>(std::max(0.0, 0.010 - 0.0005 * std::hypot(i - 39.5, j - 29.5)));
  auto scene = std::make_shared<models::Scene>();
  scene->model =
      std::make_shared<const models::Relief>(models::Relief::from_samples(height_m, 0.0005).value());
  scene->texture = Raster<Rgb8>(80, 60, Rgb8{90, 120, 150});
  scene->source.inputs = {"/somewhere/cone left.png", "/somewhere/cone right.png"};
  return scene;
}

class HostOnATouch : public ::testing::Test {
 protected:
  HostOnATouch() {
    session::SessionOptions options;
    options.servo.realtime_priority = 0;
    options.further_probes = 9;
    auto opened = session::TouchSession::open(cone_scene(), {}, "pointer:", options);
    EXPECT_TRUE(opened);
    session = std::move(opened).value();
    host = std::make_unique<TouchHost>(*session, options_for_host());
  }

  TouchHost::Options options_for_host() {
    return {"palpable test", {}, [this] { return std::exchange(better, nullptr); }, file, true};
  }

  // Beats as the server does until it holds, for ten seconds at most.
  bool comes_true(const std::function<bool()>& condition) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (std::chrono::steady_clock::now() < end) {
      host->beat();
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }

  std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "palpable_host_test.palp";
  std::shared_ptr<const models::Scene> better;
  std::unique_ptr<session::TouchSession> session;
  std::unique_ptr<TouchHost> host;
};

protocol::Change wishes(int serial) { return {serial, "proxy", 400.0, 0.5, 0.3, 1.0, 3.0}; }
protocol::Edit edit(int serial, double stiffness) {
  return {serial, 0, stiffness, 0.5, 0.4, 0.25, "ridges", 0.002, 30e-6, 90.0};
}

TEST_F(HostOnATouch, ShowsTheSceneAsItIsFelt) {
  const auto scene = host->scene();
  EXPECT_EQ(scene->about.name, "cone left.png and cone right.png");
  EXPECT_EQ(scene->about.kind, "relief");
  EXPECT_NEAR(scene->about.width_m, 0.040, 1e-9);
  EXPECT_NEAR(scene->about.depth_m, 0.030, 1e-9);
  EXPECT_TRUE(scene->about.has_picture);
  ASSERT_EQ(scene->height_m.width(), 80);
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(session->scene()->model);
  EXPECT_NEAR(scene->height_m(40, 30), relief.sample(0.00025, -0.00025).z_m, 1e-7);
  EXPECT_EQ(host->scene(), scene);
  EXPECT_TRUE(host->hello().pointer_moves);
  EXPECT_EQ(host->laws().front().name, host->settings().law);
}

TEST_F(HostOnATouch, FeelsWhereThePagePressesAndNothingWhereItLifts) {
  host->move({0, 0.0, 0.0, 0.002});
  EXPECT_TRUE(comes_true([&] { return host->state().contact && host->state().fz_N > 0.3; }));
  EXPECT_NEAR(host->state().surface_m, 0.010, 0.001);
  host->move({0, 0.0, 0.0, -0.010});
  EXPECT_TRUE(comes_true([&] { return !host->state().contact && host->state().fz_N == 0.0; }));
}

TEST_F(HostOnATouch, FeelsWithSeveralProbesUntilTheyAreLifted) {
  EXPECT_EQ(host->hello().probes, 10);
  const auto recorded = std::filesystem::path(::testing::TempDir()) / "palpable_host_test.rec";
  ASSERT_TRUE(session->start_recording(recorded));
  host->move({0, 0.0, 0.0, 0.001});
  host->move({3, 0.005, 0.0, 0.002});
  host->move({9, -0.005, 0.0, -0.004});
  const auto settled = [&] {
    const auto state = host->state();
    return state.contact && state.further == std::vector{3.0, 9.0} && state.further_fz_N[0] > 0.3 &&
           std::abs(state.further_x_m[1] + 0.005) < 1e-6;
  };
  ASSERT_TRUE(comes_true(settled));
  const auto state = host->state();
  EXPECT_NEAR(state.x_m, 0.0, 1e-6);
  EXPECT_NEAR(state.further_x_m[0], 0.005, 1e-6);
  EXPECT_GT(state.further_fx_N[0], 0.1) << "the cone falls to the right there";
  EXPECT_NEAR(state.further_surface_m[0], 0.005, 0.0005);
  EXPECT_EQ(state.further_contact, (std::vector{1.0, 0.0}));
  EXPECT_EQ(state.further_fz_N[1], 0.0);
  host->lift({3});
  EXPECT_TRUE(comes_true([&] { return host->state().further == std::vector{9.0}; }));
  EXPECT_TRUE(host->state().contact);
  EXPECT_FALSE(host->next_notice()) << "nobody need hear that a finger was lifted";
  ASSERT_TRUE(session->stop_recording());
  const auto recording = device::read_recording(recorded);
  ASSERT_TRUE(recording) << recording.error().sentence();
  std::set<int> probes;
  for (const auto& tick : recording->further) probes.insert(tick.probe);
  EXPECT_EQ(probes, (std::set{3, 9}));
  EXPECT_GE(recording->ticks.size(), recording->further.size() / 2);
}

TEST_F(HostOnATouch, ChangesSettingsAndSaysWhichChangeHolds) {
  auto change = wishes(7);
  change.exaggeration = 2.0;
  host->change(change);
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 7; }));
  EXPECT_EQ(host->settings().exaggeration, 2.0);
  EXPECT_EQ(host->settings().stiffness, 400.0);
  EXPECT_NEAR(host->scene()->about.highest_m, 0.010, 0.001) << "heights are sent at exaggeration 1";
}

TEST_F(HostOnATouch, RefusesALawThatDoesNotExistAndKeepsTheOneThere) {
  auto change = wishes(8);
  change.law = "fly";
  host->change(change);
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 8; }));
  EXPECT_EQ(host->settings().law, "proxy");
  const auto notice = host->next_notice();
  ASSERT_TRUE(notice);
  EXPECT_EQ(notice->level, "warning");
  EXPECT_EQ(notice->text, "fly: there is no such law");
}

TEST_F(HostOnATouch, OfManyChangesTheLastOneHolds) {
  for (int i = 1; i <= 50; ++i) {
    auto change = wishes(i);
    change.stiffness = 100.0 + i;
    host->change(change);
  }
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 50; }));
  EXPECT_EQ(host->settings().stiffness, 150.0);
}

TEST_F(HostOnATouch, HoldsTheForceAtZeroWhilePaused) {
  host->move({0, 0.0, 0.0, 0.002});
  ASSERT_TRUE(comes_true([&] { return host->state().fz_N > 0.3; }));
  host->pause(true);
  EXPECT_TRUE(host->settings().paused);
  EXPECT_TRUE(comes_true([&] { return host->state().fz_N == 0.0; }));
  host->pause(false);
  EXPECT_TRUE(comes_true([&] { return host->state().fz_N > 0.3; }));
}

TEST_F(HostOnATouch, EditsAMaterialUnderTheHandWithoutShowingAnotherScene) {
  host->move({0, 0.0, 0.0, 0.002});
  ASSERT_TRUE(comes_true([&] { return host->state().fz_N > 0.5; }));
  const auto shown = host->scene();
  host->edit(edit(9, 100.0));
  EXPECT_TRUE(comes_true([&] { return host->materials().answers == 9; }));
  EXPECT_EQ(host->materials().stiffness_N_per_m, std::vector{100.0});
  EXPECT_EQ(host->materials().textures, std::vector<std::string>{"ridges"});
  EXPECT_NEAR(host->materials().stickiness.front(), 0.25, 1e-12);
  EXPECT_NEAR(host->materials().angle_deg.front(), 90.0, 1e-9);
  EXPECT_EQ(host->settings().stiffness, 100.0);
  EXPECT_TRUE(comes_true([&] { return host->state().fz_N < 0.3; })) << "it is felt";
  EXPECT_TRUE(host->state().contact);
  EXPECT_EQ(host->scene(), shown);
  EXPECT_FALSE(host->next_notice());
}

TEST_F(HostOnATouch, LetsAnEditedMaterialRuleOverAWishForAllOfThem) {
  host->change(wishes(3));
  ASSERT_TRUE(comes_true([&] { return host->settings().answers == 3; }));
  ASSERT_EQ(host->settings().stiffness, 400.0);
  host->edit(edit(4, 300.0));
  ASSERT_TRUE(comes_true([&] { return host->settings().answers == 4; }));
  EXPECT_EQ(host->settings().stiffness, 300.0);
  EXPECT_FALSE(session->settings().law.stiffness_N_per_m);
}

TEST_F(HostOnATouch, RefusesAMaterialThatIsNotThere) {
  auto wish = edit(5, 300.0);
  wish.label = 7;
  host->edit(wish);
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 5; }));
  EXPECT_EQ(host->materials().stiffness_N_per_m, std::vector{500.0});
  const auto notice = host->next_notice();
  ASSERT_TRUE(notice);
  EXPECT_EQ(notice->level, "warning");
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

TEST_F(HostOnATouch, TellsOfABetterSceneOnceItIsThere) {
  ASSERT_EQ(host->scene()->about.scene, 0);
  better = cone_scene();
  EXPECT_TRUE(comes_true([&] { return host->scene()->about.scene == 1; }));
  const auto notice = host->next_notice();
  ASSERT_TRUE(notice);
  EXPECT_EQ(notice->text, "A finer version of the scene is in place");
}

TEST_F(HostOnATouch, SaysWhereTheExplorerStands) {
  EXPECT_TRUE(host->hello().egocentric);
  host->stand({0.010, -0.005, 90.0});
  std::string said;
  ASSERT_TRUE(comes_true([&] {
    if (const auto notice = host->next_notice()) said = notice->text;
    return said.starts_with("You stand");
  }));
  EXPECT_EQ(said, "You stand 10 mm right of and 5 mm below the middle, facing left.");
}

}  // namespace
}  // namespace palpable::page
