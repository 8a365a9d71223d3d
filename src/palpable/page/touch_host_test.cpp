// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/touch_host.hpp"

#include "palpable/device/recording/recording.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/page/page_state.hpp"
#include "palpable/page/test_host_on_a_touch.hpp"

#include <chrono>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

TEST_F(HostOnATouch, ShowsTheTouchedScene) {
  const auto scene = host->scene();
  EXPECT_EQ(scene->about.name, "cone left.png and cone right.png");
  EXPECT_EQ(scene->about.kind, "relief");
  EXPECT_NEAR(scene->about.size_x_m, 0.040, 1e-9);
  EXPECT_NEAR(scene->about.size_y_m, 0.030, 1e-9);
  EXPECT_TRUE(scene->about.has_picture);
  ASSERT_EQ(scene->height_m.width(), 80);
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(session->scene()->model);
  EXPECT_NEAR(scene->height_m(40, 30), relief.sample(0.00025, -0.00025).z_m, 1e-7);
  EXPECT_EQ(host->scene(), scene);
  EXPECT_TRUE(host->hello().pointer_moves);
  EXPECT_FALSE(host->hello().finds_head);
  EXPECT_FALSE(host->head());
  EXPECT_EQ(host->laws().laws.front().name, host->settings().law);
}

TEST_F(HostOnATouch, FeelsAForceOnlyWhileThePagePresses) {
  host->move({0, 0.0, 0.0, 0.002});
  EXPECT_TRUE(comes_true([&] { return first().contact && first().fz_N > 0.3; }));
  EXPECT_NEAR(first().surface_m, 0.010, 0.001);
  host->move({0, 0.0, 0.0, -0.010});
  EXPECT_TRUE(comes_true([&] { return !first().contact && first().fz_N == 0.0; }));
}

TEST_F(HostOnATouch, FeelsWithSeveralProbesUntilTheyAreLifted) {
  EXPECT_EQ(host->hello().probes, 10);
  host->move({0, 0.0, 0.0, 0.001});
  host->move({3, 0.005, 0.0, 0.002});
  host->move({9, -0.005, 0.0, -0.004});
  const auto numbers = [&] {
    std::vector<std::int64_t> all;
    for (const auto& probe : host->state().probes) all.push_back(probe.probe);
    return all;
  };
  const auto settled = [&] {
    const auto state = host->state();
    return numbers() == std::vector<std::int64_t>{0, 3, 9} && state.probes[0].contact &&
           state.probes[1].fz_N > 0.3 && std::abs(state.probes[2].x_m + 0.005) < 1e-6;
  };
  ASSERT_TRUE(comes_true(settled));
  const auto state = host->state();
  EXPECT_NEAR(state.probes[0].x_m, 0.0, 1e-6);
  EXPECT_NEAR(state.probes[1].x_m, 0.005, 1e-6);
  EXPECT_GT(state.probes[1].fx_N, 0.1) << "the cone falls to the right there";
  EXPECT_NEAR(state.probes[1].surface_m, 0.005, 0.0005);
  EXPECT_TRUE(state.probes[1].contact);
  EXPECT_FALSE(state.probes[2].contact);
  EXPECT_EQ(state.probes[2].fz_N, 0.0);
  host->lift({3});
  EXPECT_TRUE(comes_true([&] { return numbers() == std::vector<std::int64_t>{0, 9}; }));
  EXPECT_TRUE(first().contact);
  EXPECT_FALSE(host->next_notice()) << "lifting a finger is no news";
  ASSERT_TRUE(session->stop());
  const auto recording = device::read_recording(recorded);
  ASSERT_TRUE(recording) << recording.error().sentence();
  std::set<int> probes;
  for (const auto& tick : recording->further) probes.insert(tick.probe);
  EXPECT_EQ(probes, (std::set{3, 9}));
  EXPECT_GE(recording->ticks.size(), recording->further.size() / 2);
}

TEST_F(HostOnATouch, ChangesSettingsAndReportsTheSerial) {
  auto change = change_of(7);
  change.height_factor = 2.0;
  host->change(change);
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 7; }));
  EXPECT_EQ(host->settings().height_factor, 2.0);
  EXPECT_EQ(stiffness_in(host->settings()), 400.0);
  EXPECT_NEAR(host->scene()->about.highest_m, 0.010, 0.001) << "heights are sent at a height factor of 1";
}

TEST_F(HostOnATouch, RefusesAnUnknownLawAndKeepsTheCurrentOne) {
  auto change = change_of(8);
  change.law = "fly";
  host->change(change);
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 8; }));
  EXPECT_EQ(host->settings().law, "proxy");
  const auto notice = host->next_notice();
  ASSERT_TRUE(notice);
  EXPECT_EQ(notice->level, "warning");
  EXPECT_EQ(notice->text, "fly: there is no such law");
}

TEST_F(HostOnATouch, AppliesTheLastOfManyChanges) {
  for (int i = 1; i <= 50; ++i) {
    host->change(change_of(i, 100.0 + i));
  }
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 50; }));
  EXPECT_EQ(stiffness_in(host->settings()), 150.0);
}

TEST_F(HostOnATouch, DistinguishesAValueEqualToTheMaterialsFromAnUnsetOne) {
  const double own = stiffness_in(host->settings());
  EXPECT_FALSE(parameter(host->settings(), "stiffness_N_per_m").set);
  host->change(change_of(1, own));
  ASSERT_TRUE(comes_true([&] { return host->settings().answers == 1; }));
  EXPECT_EQ(parameter(host->settings(), "stiffness_N_per_m").set, own)
      << "set, although it is the same value";
  EXPECT_EQ(session->settings().law.stiffness_N_per_m, own);
  host->change({2, "proxy", {}, 1.0});
  ASSERT_TRUE(comes_true([&] { return host->settings().answers == 2; }));
  EXPECT_FALSE(session->settings().law.stiffness_N_per_m);
  EXPECT_EQ(stiffness_in(host->settings()), own);
}

TEST_F(HostOnATouch, RefusesAParameterThatTheLawDoesNotHave) {
  auto change = change_of(8);
  change.parameters = {{"neighbourhood_px", 3.0}};
  host->change(change);
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 8; }));
  const auto notice = host->next_notice();
  ASSERT_TRUE(notice);
  EXPECT_EQ(notice->text, "neighbourhood_px: the law proxy has no such parameter");
}

TEST_F(HostOnATouch, HoldsTheForceAtZeroWhilePaused) {
  host->move({0, 0.0, 0.0, 0.002});
  ASSERT_TRUE(comes_true([&] { return first().fz_N > 0.3; }));
  host->pause(true);
  EXPECT_TRUE(host->settings().paused);
  EXPECT_TRUE(comes_true([&] { return first().fz_N == 0.0; }));
  host->pause(false);
  EXPECT_TRUE(comes_true([&] { return first().fz_N > 0.3; }));
}

/// Writes down what it is asked for.
class FakeRobot final : public session::RobotControl {
 public:
  void request_start() override { asked += "start "; }
  void request_stop() override { asked += "stop "; }
  void request_mode(session::RobotMode mode) override {
    asked += mode == session::RobotMode::look ? "look " : "mode ";
  }
  void request_view(session::RobotView view) override {
    asked += view == session::RobotView::near ? "near " : "wide ";
  }
  session::RobotStatistics statistics() const override { return {}; }
  session::RobotState state() const override { return {}; }
  std::shared_ptr<const session::RobotFloor> floor() const override { return nullptr; }
  std::optional<std::string> state_notice() override { return std::nullopt; }

  std::string asked;
};

TEST_F(HostOnATouch, StartsARobotByAnOrderAloneAndFromTheMiddle) {
  FakeRobot robot;
  auto options = options_for_host();
  options.robot = &robot;
  TouchHost driving(*session, options);
  EXPECT_FALSE(host->robot());
  ASSERT_TRUE(driving.robot());
  EXPECT_EQ(driving.robot()->mode, "drive");
  driving.move({0, 0.015, 0.0, -0.01});
  driving.update();
  EXPECT_EQ(robot.asked, "");
  driving.order({"start"});
  EXPECT_TRUE(palpable::comes_true([&] {
    driving.update();
    return std::abs(driving.state().probes.front().x_m) < 1e-6;
  }));
  for (const char* word : {"look", "near", "wide", "jump", "", "stop"}) driving.order({word});
  driving.pause(true);
  driving.pause(false);
  driving.let_go();
  EXPECT_EQ(robot.asked, "start look near wide stop stop stop ");
}

TEST_F(HostOnATouch, TakesAPageThatIsSilentForAReleasedHandIfThereIsARobot) {
  FakeRobot robot;
  auto options = options_for_host();
  options.robot = &robot;
  TouchHost driving(*session, options);
  const auto becomes = [&](device::Status status) {
    return palpable::comes_true([&] {
      driving.update();
      return session->latest().status == status;
    });
  };
  driving.move({0, 0.015, 0.0, -0.01});
  EXPECT_TRUE(becomes(device::Status::ok));
  EXPECT_TRUE(becomes(device::Status::stale));
  driving.move({0, 0.015, 0.0, -0.01});
  EXPECT_TRUE(becomes(device::Status::ok));
}

TEST_F(HostOnATouch, EditsAMaterialUnderTheHandWithoutANewScene) {
  host->move({0, 0.0, 0.0, 0.002});
  ASSERT_TRUE(comes_true([&] { return first().fz_N > 0.5; }));
  const auto shown = host->scene();
  host->edit(edit(9, 100.0));
  EXPECT_TRUE(comes_true([&] { return host->materials().answers == 9; }));
  ASSERT_EQ(host->materials().materials.size(), 1U);
  EXPECT_FALSE(host->materials().materials.front().name) << "it has none";
  const auto material = host->materials().materials.front().material;
  EXPECT_EQ(material.stiffness_N_per_m, 100.0);
  EXPECT_EQ(material.texture.kind, "ridges");
  EXPECT_NEAR(material.stickiness, 0.25, 1e-12);
  EXPECT_NEAR(material.texture.angle_deg, 90.0, 1e-9);
  EXPECT_EQ(stiffness_in(host->settings()), 100.0);
  EXPECT_TRUE(comes_true([&] { return first().fz_N < 0.3; })) << "it is felt";
  EXPECT_TRUE(first().contact);
  EXPECT_EQ(host->scene(), shown);
  EXPECT_FALSE(host->next_notice());
}

TEST_F(HostOnATouch, PrefersAnEditedMaterialToAValueSetForAll) {
  host->change(change_of(3));
  ASSERT_TRUE(comes_true([&] { return host->settings().answers == 3; }));
  ASSERT_EQ(stiffness_in(host->settings()), 400.0);
  host->edit(edit(4, 300.0));
  ASSERT_TRUE(comes_true([&] { return host->settings().answers == 4; }));
  EXPECT_EQ(stiffness_in(host->settings()), 300.0);
  EXPECT_FALSE(session->settings().law.stiffness_N_per_m);
}

TEST(DevicePlace, IsTheOriginAndTurnOfTheDevicesOwnPositions) {
  Transform<SceneFrame, DeviceFrame> place;
  place.rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  place.translation_m = {0.01, -0.02, 0.003};
  place.scale = 0.5;
  const auto shown = device_place(place);
  EXPECT_EQ(shown.x_m, 0.01);
  EXPECT_EQ(shown.y_m, -0.02);
  EXPECT_EQ(shown.z_m, 0.003);
  EXPECT_NEAR(shown.turned_deg, 90.0, 1e-12);
  protocol::State state, other;
  other.t_s = 1.0;
  EXPECT_TRUE(nearly_equal(state, other));
  other.device.z_m += 1e-4;
  EXPECT_FALSE(nearly_equal(state, other));
}

TEST_F(HostOnATouch, KeepsValuesThatAnEditDoesNotName) {
  host->change(change_of(3));
  ASSERT_TRUE(comes_true([&] { return host->settings().answers == 3; }));
  auto expected = host->materials().materials.front().material;
  protocol::Edit friction{4, 0, {}};
  friction.material.friction = 0.8;
  host->edit(friction);
  ASSERT_TRUE(comes_true([&] { return host->materials().answers == 4; }));
  const auto after = host->materials().materials.front().material;
  EXPECT_NEAR(after.stickiness, expected.stickiness, 1e-12);
  expected.friction = 0.8;
  expected.stickiness = after.stickiness;
  EXPECT_EQ(after, expected);
  EXPECT_EQ(session->settings().law.stiffness_N_per_m, 400.0) << "set for all materials, and still so";
}

TEST_F(HostOnATouch, RefusesAnUnknownMaterial) {
  auto request = edit(5, 300.0);
  request.label = 7;
  host->edit(request);
  EXPECT_TRUE(comes_true([&] { return host->settings().answers == 5; }));
  EXPECT_EQ(host->materials().materials.front().material.stiffness_N_per_m, 500.0);
  const auto notice = host->next_notice();
  ASSERT_TRUE(notice);
  EXPECT_EQ(notice->level, "warning");
}

TEST_F(HostOnATouch, ReportsAFinerSceneOnce) {
  ASSERT_EQ(host->scene()->about.scene, 0);
  better = cone_scene();
  EXPECT_TRUE(comes_true([&] { return host->scene()->about.scene == 1; }));
  const auto notice = host->next_notice();
  ASSERT_TRUE(notice);
  EXPECT_EQ(notice->text, "A finer version of the scene is in place.");
}

TEST_F(HostOnATouch, AnswersQuestionsWithWords) {
  const auto answer = [&](const char* what, std::int64_t part = 0) {
    protocol::Ask ask;
    ask.what = what;
    ask.press_m = 0.0015;
    ask.part = part;
    return host->answer(ask).text;
  };
  EXPECT_TRUE(answer("opening").starts_with("Ready to touch: ")) << answer("opening");
  EXPECT_NE(answer("scene").find("1 object rises above the ground"), std::string::npos) << answer("scene");
  EXPECT_NE(answer("scene", 1).find("From the probe to the highest point"), std::string::npos);
  EXPECT_NE(answer("position").find("at the middle. Height "), std::string::npos) << answer("position");
  EXPECT_EQ(answer("press"), "Pressed 1.5 millimetres deep.");
  EXPECT_NE(answer("probe").find("force 0 newtons"), std::string::npos) << answer("probe");
  EXPECT_EQ(answer("nonsense"), "");
}

TEST_F(HostOnATouch, ReportsTheExplorersPose) {
  EXPECT_TRUE(host->hello().egocentric);
  host->move_explorer({0.010, -0.005, 90.0});
  std::string said;
  ASSERT_TRUE(comes_true([&] {
    if (const auto notice = host->next_notice()) said = notice->text;
    return said.starts_with("You stand");
  }));
  EXPECT_EQ(said, "You stand 10 millimetres right of and 5 millimetres below the middle, facing left.");
}

}  // namespace
}  // namespace palpable::page
