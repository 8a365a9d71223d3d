// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/headless.hpp"

#include "palpable/device/drivers/open.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/device/virtual/virtual_two_diy.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/session/check/replayed_touch.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/recorder.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::session {
namespace {

std::shared_ptr<const models::Scene> hills(double height_m) {
  return std::make_shared<const models::Scene>(hilly_scene(height_m));
}

Result<void> two_scenes(const DeliverScene& deliver, const Work&) {
  deliver(hills(0.010));
  deliver(hills(0.012));
  return {};
}

TEST(TouchHeadless, IsTheSameAgainWhereTicksCountAsTime) {
  const auto touched = [](const char* name, std::uint64_t seed) {
    auto options = unprivileged(1.5);
    options.repeatable = true;
    options.session.seed = seed;
    options.recording = std::filesystem::path(testing::TempDir()) / name;
    EXPECT_TRUE(touch_headless(two_scenes, options, {}));
    const auto recording = device::read_recording(options.recording);
    EXPECT_TRUE(recording && recording->complete);
    return recording ? recording->ticks : std::vector<device::TouchSample>();
  };
  const auto same = [](const device::TouchSample& a, const device::TouchSample& b) {
    return a.t_s == b.t_s && a.dt_s == b.dt_s && a.device_position == b.device_position &&
           a.raw_force_N == b.raw_force_N && a.written_force_N == b.written_force_N && a.flags == b.flags &&
           a.energy_J == b.energy_J;
  };
  const auto once = touched("repeated-1.rec", 3), again = touched("repeated-2.rec", 3);
  ASSERT_EQ(once.size(), 1500U);
  ASSERT_EQ(again.size(), once.size());
  double most_N = 0.0;
  for (std::size_t i = 0; i < once.size(); ++i) {
    ASSERT_TRUE(same(once[i], again[i])) << "tick " << i;
    EXPECT_DOUBLE_EQ(once[i].dt_s, 0.001);
    most_N = std::max(most_N, norm(once[i].written_force_N));
  }
  EXPECT_GT(most_N, 0.2);
  const auto other = touched("repeated-3.rec", 4);
  ASSERT_EQ(other.size(), once.size());
  EXPECT_FALSE(std::equal(other.begin(), other.end(), once.begin(), same));
}

TEST(TouchHeadless, ReplacesTheSceneByABetterOneDuringTheTouch) {
  auto options = unprivileged(2.0);
  options.recording = std::filesystem::path(testing::TempDir()) / "headless.rec";
  const auto statistics = touch_headless(two_scenes, options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  const auto& touch = statistics->servo.touch;
  EXPECT_GT(touch.contact_ticks, 0U);
  EXPECT_EQ(statistics->servo.allocations_in_ticks, 0U);
  EXPECT_LE(touch.max_force_N, 3.3 + 1e-9);
  EXPECT_GT(statistics->seconds_to_scene, 0.0);
  EXPECT_GT(statistics->seconds_to_first_force, statistics->seconds_to_scene);
  const auto recording = device::read_recording(options.recording);
  ASSERT_TRUE(recording) << recording.error().sentence();
  EXPECT_TRUE(recording->complete);
  EXPECT_EQ(recording->scenes.size(), 2U);
  // The ticks before the recording began are not in it.
  EXPECT_GT(recording->ticks.size(), 0U);
  EXPECT_LE(recording->ticks.size() + recording->lost, touch.ticks);
  EXPECT_EQ(recording->ticks.back().scene_id, 2U);
  const auto json = nlohmann::json::parse(to_json(*statistics));
  EXPECT_EQ(json["servo"]["ticks"], touch.ticks);
  EXPECT_EQ(json["allocations_in_ticks"], 0);
  EXPECT_EQ(json["seconds_to_scene"], statistics->seconds_to_scene);
}

TEST(TouchHeadless, SaysThatItsDeviceIsSilentAndThatItAnswersAgain) {
  device::VirtualTwoDiy board(device::kTwoDiyVariants[0]);
  auto options = unprivileged(20.0);
  options.device_url = "2diy:" + board.path();
  std::vector<std::string> notices;
  std::atomic<bool> answers_again{false};
  options.on_device = [&](const std::string& notice, bool tells_of_force) {
    EXPECT_TRUE(tells_of_force) << notice;
    notices.push_back(notice);
    // Too early for a failed device.
    if (notice.starts_with("The device does not answer")) board.inject(device::VirtualTwoDiy::Fault::none);
    answers_again = answers_again || notice == "The device answers again.";
  };
  std::thread trouble([&] {
    board.wait_for(200);
    board.inject(device::VirtualTwoDiy::Fault::silent);
  });
  Work until_then;
  until_then.cancel = &answers_again;
  const auto statistics = touch_headless(two_scenes, options, until_then);
  trouble.join();
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  const auto place_of = [&](const std::string& words) {
    const auto found =
        std::find_if(notices.begin(), notices.end(), [&](const auto& one) { return one.starts_with(words); });
    return found - notices.begin();
  };
  const auto count = static_cast<std::ptrdiff_t>(notices.size());
  EXPECT_LT(place_of("The device does not answer"), count);
  EXPECT_LT(place_of("The device answers again."), count);
  EXPECT_LT(place_of("The device does not answer"), place_of("The device answers again."));
}

TEST(TouchHeadless, EndsWithASentenceWhenItsDeviceFails) {
  device::VirtualTwoDiy board(device::kTwoDiyVariants[0]);
  auto options = unprivileged(600.0);
  options.device_url = "2diy:" + board.path();
  std::thread breaks([&board] {
    board.wait_for(200);
    board.inject(device::VirtualTwoDiy::Fault::silent);
  });
  const auto statistics = touch_headless(two_scenes, options, {});
  breaks.join();
  ASSERT_FALSE(statistics);
  EXPECT_EQ(statistics.error().code, ErrorCode::device);
  EXPECT_NE(statistics.error().message.find("gives no valid position"), std::string::npos);
  EXPECT_TRUE(board.wait_until_free());
}

TEST(TouchHeadless, AnExplorerStandsInABetterSceneAsTheyStood) {
  auto options = unprivileged(1.5);
  options.recording = std::filesystem::path(testing::TempDir()) / "explorer.rec";
  options.walk = {{0.0, {0.02, 0.01, std::numbers::pi / 2.0}}};
  const auto statistics = touch_headless(two_scenes, options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  const auto recording = device::read_recording(options.recording);
  ASSERT_TRUE(recording) << recording.error().sentence();
  ASSERT_GE(recording->scenes.size(), 2U);
  const auto place = nlohmann::json::parse(recording->scenes.back().json)["scene_from_device"];
  EXPECT_NEAR(place["rotation"][1].get<double>(), -1.0, 1e-9);  // what is ahead lies to the left
  EXPECT_NEAR(place["translation_m"][0].get<double>(), 0.02, 1e-9);
  EXPECT_NEAR(place["translation_m"][1].get<double>(), 0.01, 1e-9);
}

TEST(TouchHeadless, RecordsEveryTickToTheLastOfTheLoop) {
  auto options = unprivileged(0.5);
  options.session.further_devices = {"sim:?seed=7"};
  options.recording = std::filesystem::path(testing::TempDir()) / "every-tick.rec";
  const auto statistics = touch_headless(two_scenes, options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  ASSERT_EQ(statistics->further_hands.size(), 1U);
  const std::uint64_t ticks[]{statistics->servo.touch.ticks, statistics->further_hands[0].servo.touch.ticks};
  for (std::size_t hand = 0; hand < 2; ++hand) {
    const auto recording = device::read_recording(recording_of_hand(options.recording, hand));
    ASSERT_TRUE(recording) << recording.error().sentence();
    ASSERT_EQ(recording->lost, 0U);
    ASSERT_FALSE(recording->ticks.empty());
    EXPECT_EQ(recording->ticks.size(), ticks[hand]);
    EXPECT_EQ(recording->ticks.back().tick + 1, ticks[hand]);
  }
}

TEST(Recorder, StoresForcesThatTheLawReproducesToTheLastBit) {
  const auto scene = hills(0.010);
  const auto device = device::open_device("sim:", {});
  ASSERT_TRUE(device);
  const auto& traits = (*device)->traits();
  KeptSurfaces kept;
  const auto prepared =
      prepare_scene(*scene, {}, traits, 1000.0, haptics::fit_workspace(*scene, traits), kept);
  ASSERT_TRUE(prepared) << prepared.error().sentence();
  Ring<haptics::TouchEvent> events(4096);
  haptics::TickPipeline tick(**device, prepared->scene, {}, events);
  std::vector<device::TouchSample> ticks;
  for (int n = 0; n < 3000; ++n) ticks.push_back(tick.step(0.001 * n, 0.001));
  const auto file = std::filesystem::path(testing::TempDir()) / "again.rec";
  auto writer = device::RecordingWriter::create(file, "{}");
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*writer)->write(ticks));
  ASSERT_TRUE((*writer)->finish(0));
  const auto recording = device::read_recording(file);
  ASSERT_TRUE(recording) << recording.error().sentence();
  ASSERT_EQ(recording->ticks, ticks);
  haptics::TouchState state;
  RecordedSession session;
  session.traits = traits;
  ReplayedHand replayed(session);
  int in_contact = 0;
  for (const auto& recorded : recording->ticks) {
    replayed.step(recorded);
    const auto output = prepared->scene.touchable->evaluate(replayed.in(prepared->scene), state);
    ASSERT_EQ(output.force_N, recorded.raw_force_N) << "tick " << recorded.tick;
    in_contact += output.contact ? 1 : 0;
  }
  EXPECT_GT(in_contact, 1000);
}

TEST(TouchHeadless, SaysWhyNoSceneCame) {
  const auto fails = [](const DeliverScene&, const Work&) -> Result<void> {
    return invalid_input("is no picture", "a.txt");
  };
  const auto statistics = touch_headless(fails, unprivileged(1.0), {});
  ASSERT_FALSE(statistics);
  EXPECT_EQ(statistics.error().sentence(), "a.txt: is no picture");
}

TEST(TouchHeadless, EndsAtOnceWhenInterruptedAndTellsTheMaker) {
  std::atomic<bool> cancel{true};
  Work work;
  work.cancel = &cancel;
  std::atomic<bool> told{false};
  const auto waits = [&](const DeliverScene&, const Work& own) -> Result<void> {
    while (!own.cancelled()) std::this_thread::yield();
    told = true;
    return Work::interrupted();
  };
  const auto statistics = touch_headless(waits, unprivileged(1000.0), work);
  ASSERT_FALSE(statistics);
  EXPECT_EQ(statistics.error().code, ErrorCode::interrupted);
  EXPECT_TRUE(told);
}

TEST(TouchHeadless, RefusesADeviceThatDoesNotExist) {
  auto options = unprivileged(1.0);
  options.device_url = "falcn:";
  const auto statistics = touch_headless(two_scenes, options, {});
  ASSERT_FALSE(statistics);
  EXPECT_EQ(statistics.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::session
