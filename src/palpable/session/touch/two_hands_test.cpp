// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/test_comes_true.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/device/virtual/virtual_two_diy.hpp"
#include "palpable/session/check/check_recording.hpp"
#include "palpable/session/touch/headless.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::session {
namespace {

using device::Status;

std::shared_ptr<const models::Scene> hills() {
  return std::make_shared<const models::Scene>(hilly_scene(0.01));
}

Result<void> one_scene(const DeliverScene& deliver, const Work&) {
  deliver(hills());
  return {};
}

double force_N(const TouchSession& session, std::size_t probe) {
  return norm(session.latest(probe).written_force_N.v);
}

TEST(TwoHands, TouchWithMotorsOfDifferentDevicesAndAreEachRecorded) {
  device::VirtualTwoDiy board(device::kTwoDiyVariants[0]);
  auto options = unprivileged(2.0);
  options.device_url = "sim:?seed=3";
  options.session.further_devices = {"2diy:" + board.path(), "sim:?mass=0.2&max-force=1"};
  options.recording = std::filesystem::path(testing::TempDir()) / "hands.rec";
  std::vector<std::string> notices;
  options.on_notice = [&](const std::string& notice) { notices.push_back(notice); };
  options.on_device = [&](const std::string& sentence, bool) { notices.push_back(sentence); };
  const auto statistics = touch_headless(one_scene, options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  ASSERT_EQ(statistics->further_hands.size(), 2U);
  EXPECT_GT(statistics->servo.touch.contact_ticks, 0U);
  for (const auto& hand : statistics->further_hands) {
    EXPECT_GT(hand.servo.touch.contact_ticks, 0U) << hand.device;
    EXPECT_EQ(hand.servo.allocations_in_ticks, 0U);
  }
  // Each hand keeps to its own device's limits, and says so in its own name.
  EXPECT_LE(statistics->further_hands[1].servo.touch.max_force_N, 1.0 + 1e-9);
  EXPECT_GT(statistics->servo.touch.max_force_N, 0.0);
  for (const std::string& notice : notices) EXPECT_TRUE(notice.starts_with("Hand ")) << notice;
  const auto json = nlohmann::json::parse(to_json(*statistics));
  ASSERT_EQ(json["further_hands"].size(), 2U);
  EXPECT_EQ(json["further_hands"][1]["servo"]["ticks"], statistics->further_hands[1].servo.touch.ticks);
  for (std::size_t hand = 0; hand < 3; ++hand) {
    const auto recording = device::read_recording(recording_of_hand(options.recording, hand));
    ASSERT_TRUE(recording) << recording.error().sentence();
    EXPECT_TRUE(recording->complete);
    EXPECT_GT(recording->ticks.size(), 0U);
  }
  EXPECT_EQ(recording_of_hand("a/b.rec", 1), "a/b-2.rec");
}

TEST(TwoHands, AFailedHandIsOpenedAgainWhileTheOtherTouches) {
  device::VirtualTwoDiy board(device::kTwoDiyVariants[0]);
  SessionOptions options = unprivileged(1.0).session;
  options.further_devices = {"2diy:" + board.path()};
  options.further_probes = 2;
  auto opened = TouchSession::open(hills(), {}, "sim:", options);
  ASSERT_TRUE(opened) << opened.error().sentence();
  TouchSession& session = **opened;
  EXPECT_EQ(session.hands(), 2U);
  EXPECT_EQ(session.probes(), 4U);
  ASSERT_TRUE(comes_true([&] { return force_N(session, 0) > 0.05 && force_N(session, 1) > 0.02; }));
  // Further probes keep their numbers behind the hands.
  ASSERT_TRUE(comes_true([&] {
    session.move_pointer({{0.0, 0.0, 0.0}}, 3);
    return session.latest(3).status == Status::ok;
  }));
  EXPECT_EQ(session.latest(3).probe, 3);
  EXPECT_NE(session.latest(2).status, Status::ok);

  board.inject(device::VirtualTwoDiy::Fault::silent);
  ASSERT_TRUE(comes_true([&] { return session.latest(1).status != Status::ok; }));
  ASSERT_TRUE(comes_true([&] { return session.latest(1).status == Status::fault; }));
  EXPECT_NE(session.device_fault(1), "");
  EXPECT_EQ(session.device_fault(0), "");
  const auto ticks = session.statistics().servo.touch.ticks;
  // It is closed after a second: the other hand goes on.
  ASSERT_TRUE(comes_true([&] { return session.take_guidance().starts_with("Hand 2 ("); }));
  EXPECT_EQ(session.latest(0).status, Status::ok);
  EXPECT_GT(session.statistics().servo.touch.ticks, ticks);
  board.inject(device::VirtualTwoDiy::Fault::none);
  ASSERT_TRUE(
      comes_true([&] { return session.latest(1).status == Status::ok && force_N(session, 1) > 0.02; }));
  bool told = false;
  for (const auto& event : session.take_events())
    told = told || (event.probe == 1 && event.kind == haptics::TouchEvent::Kind::recovered);
  EXPECT_TRUE(told);

  session.pause();
  ASSERT_TRUE(comes_true([&] { return force_N(session, 0) == 0.0 && force_N(session, 1) == 0.0; }));
  EXPECT_TRUE(session.stop());
  EXPECT_EQ(board.torques()[0], 0.0);
  EXPECT_EQ(board.torques()[1], 0.0);
}

TEST(TwoHands, NamesDevicesThatCannotBeTouchedTogether) {
  const auto error_of = [](const std::string& first, const std::vector<std::string>& more) {
    SessionOptions options = unprivileged(1.0).session;
    options.further_devices = more;
    auto opened = TouchSession::open(hills(), {}, first, options);
    EXPECT_FALSE(opened) << first;
    return opened ? Error{} : opened.error();
  };
  EXPECT_EQ(error_of("falcon:0", {"falcon:0"}).code, ErrorCode::usage);
  EXPECT_EQ(error_of("touch:Left", {"touch:Right"}).code, ErrorCode::usage);
  EXPECT_EQ(error_of("pointer:", {"sim:"}).code, ErrorCode::usage);
  EXPECT_EQ(error_of("sim:", {"falcn:"}).code, ErrorCode::usage);
  EXPECT_EQ(error_of("sim:?motors=one", {"sim:?seed=2&motors=one"}).code, ErrorCode::usage);
  device::VirtualTwoDiy board(device::kTwoDiyVariants[0]);
  const Error twice = error_of("2diy:" + board.path(), {"2diy:" + board.path() + "?variant=v3"});
  EXPECT_EQ(twice.code, ErrorCode::usage) << twice.sentence();
}

TEST(TwoHands, TellWhereTheirDevicesAreInTheScene) {
  SessionOptions options = unprivileged(1.0).session;
  options.workspace.magnification = 2.0;
  options.workspace.clutch_button = 0;
  options.further_devices = {"sim:"};
  auto opened = TouchSession::open(hills(), {}, "sim:?button=1&button-at=0.5&button-for=0.5", options);
  ASSERT_TRUE(opened) << opened.error().sentence();
  TouchSession& session = **opened;
  const auto moved_m = [&, first = session.scene_from_device(0)] {
    return norm(session.scene_from_device(0).translation_m - first.translation_m);
  };
  EXPECT_TRUE(comes_true([&] { return moved_m() > 1e-4; })) << "the clutch moves the scene with the hand";
  const auto before = session.scene_from_device(1);
  session.recentre();
  EXPECT_TRUE(comes_true(
      [&] { return norm(session.scene_from_device(1).translation_m - before.translation_m) > 1e-6; }));
}

TEST(TwoHands, EachReachesAMagnifiedSceneWithItsOwnDevice) {
  SessionOptions options = unprivileged(1.0).session;
  options.workspace.magnification = 2.0;
  options.workspace.clutch_button = 0;
  options.further_devices = {"sim:?max-force=2"};
  auto opened = TouchSession::open(hills(), {}, "sim:", options);
  ASSERT_TRUE(opened) << opened.error().sentence();
  for (std::size_t hand = 0; hand < 2; ++hand) {
    EXPECT_TRUE(comes_true([&] { return force_N(**opened, hand) > 0.05; })) << hand;
    const auto touched = (*opened)->latest(hand);
    // A scene as wide as the workspace is felt twice as wide.
    EXPECT_NEAR(touched.position.v.x, 0.5 * touched.device_position.v.x, 5e-5);
  }
  haptics::TouchEvent event{0, haptics::TouchEvent::Kind::button_down, 0, 1};
  EXPECT_EQ((*opened)->event_words(event),
            "Hand 2 (simulated hand): The scene moves with the hand, without force.");
  event.value = 1;
  EXPECT_EQ((*opened)->event_words(event), "");
  // What is moved by a page or was moved before has no border.
  options.further_devices.clear();
  EXPECT_FALSE(TouchSession::open(hills(), {}, "pointer:", options));
  options.workspace.magnification = 11.0;
  EXPECT_FALSE(TouchSession::open(hills(), {}, "sim:", options));
}

}  // namespace
}  // namespace palpable::session
