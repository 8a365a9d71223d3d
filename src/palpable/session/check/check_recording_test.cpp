// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/check/check_recording.hpp"

#include "palpable/core/files/crc32.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/session/check/test_recordings.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace palpable::session {
namespace {

TEST(CheckRecording, RecomputesEveryTickOfATouchToTheLastBit) {
  const auto report = checked(one_touch(), {waves(0.010)});
  // On a busy machine the simulated hand moves by a tick's way in a longer time, so that it is damped less.
  EXPECT_TRUE(report.is_clean() || report.missed > 0) << said(report);
  EXPECT_GT(report.ticks, 100U);
  EXPECT_GT(report.contact_ticks, 0U);
  EXPECT_EQ(report.recomputed, report.ticks);
  EXPECT_EQ(report.differing, 0U);
  EXPECT_EQ(report.max_difference_N, 0.0);
  EXPECT_EQ(report.laws, std::vector<std::string>{"proxy"});
}

TEST(CheckRecording, ContinuesThroughAChangeOfScene) {
  auto options = recorded_touch_of(2.0, "two-scenes.rec");
  ASSERT_TRUE(touch_headless(makes({waves(0.010), waves(0.012)}), options, {}));
  const auto report = checked(options.recording, {waves(0.012), waves(0.010)});
  EXPECT_TRUE(report.is_clean()) << said(report);
  EXPECT_EQ(report.recomputed, report.ticks);
  EXPECT_EQ(report.scene_hashes.size(), 2U);
}

TEST(CheckRecording, RecomputesTheVibrationOfASurfaceThatIsStruck) {
  auto options = recorded_touch_of(2.0, "transient.rec");
  options.settings.transient = haptics::TransientKind::wood;
  const auto statistics = touch_headless(makes({waves(0.010)}), options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  EXPECT_GT(statistics->servo.touch.transients, 0U);
  EXPECT_EQ(statistics->servo.allocations_in_ticks, 0U);
  const auto report = checked(options.recording, {waves(0.010)});
  EXPECT_EQ(report.recomputed, report.ticks) << said(report);
  EXPECT_EQ(report.differing, 0U) << said(report);
}

TEST(CheckRecording, RecomputesForceAndTorqueOfATool) {
  recipes::FieldRecipe recipe;
  recipe.field.resolution = 48;
  models::Superquadric ball;
  ball.size_m = {0.03, 0.03, 0.015};
  auto made = recipes::field_from_superquadrics({ball}, recipe, {});
  ASSERT_TRUE(made) << made.error().sentence();
  const auto scene = std::make_shared<const models::Scene>(std::move(made->scene));
  auto options = recorded_touch_of(3.0, "tool.rec");
  options.device_url = "sim:?torque=1&seed=3&tilt=0.5";
  options.settings.law.law = haptics::Law::tool;
  const auto statistics = touch_headless(makes({scene}), options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  EXPECT_EQ(statistics->servo.allocations_in_ticks, 0U);
  const auto report = checked(options.recording, {scene});
  EXPECT_EQ(report.recomputed, report.ticks) << said(report);
  EXPECT_EQ(report.differing, 0U) << said(report);
  EXPECT_EQ(report.laws, std::vector<std::string>{"tool"});
  EXPECT_GT(report.contact_ticks, 100U);
  const auto recording = *device::read_recording(options.recording);
  EXPECT_TRUE(
      std::any_of(recording.ticks.begin(), recording.ticks.end(),
                  [](const device::TouchSample& tick) { return norm(tick.written_torque_Nm) > 1e-4; }));
}

TEST(CheckRecording, FindsOneForceThatWasChangedInOneBit) {
  const auto file = altered(one_touch(), "one-bit.rec", [](device::Recording& recording) {
    double& z = recording.ticks[first_in_contact(recording)].written_force_N.v.z;
    z = std::nextafter(z, 10.0);
  });
  const auto report = checked(file, {waves(0.010)});
  EXPECT_FALSE(report.is_clean());
  EXPECT_EQ(report.differing, 1U);
  EXPECT_TRUE(found(report, FindingKind::written_force)) << said(report);
}

TEST(CheckRecording, FindsAPositionThatWasChanged) {
  const auto file = altered(one_touch(), "place.rec", [](device::Recording& recording) {
    recording.ticks[first_in_contact(recording)].device_position.v.z -= 1e-5;
  });
  const auto report = checked(file, {waves(0.010)});
  EXPECT_FALSE(report.is_clean());
  EXPECT_TRUE(found(report, FindingKind::law_force)) << said(report);
}

TEST(CheckRecording, FindsStepsForcesInAirAndMissingTicksWithoutTheScene) {
  const auto file = altered(one_touch(), "steps.rec", [](device::Recording& recording) {
    auto& ticks = recording.ticks;
    const auto in_air = std::find_if(ticks.begin() + 20, ticks.end(), [](const device::TouchSample& tick) {
      return !tick.has(haptics::flag::kContact);
    });
    ASSERT_NE(in_air, ticks.end());
    in_air->written_force_N.v.z = 2.5;
    ticks[ticks.size() - 10].written_force_N.v.x = 50.0;
    ticks.erase(ticks.end() - 5);
  });
  const auto report = checked(file, {});
  EXPECT_TRUE(found(report, FindingKind::force_step)) << said(report);
  EXPECT_TRUE(found(report, FindingKind::free_air)) << said(report);
  EXPECT_TRUE(found(report, FindingKind::force_cap)) << said(report);
  EXPECT_TRUE(found(report, FindingKind::lost_ticks)) << said(report);
  EXPECT_TRUE(found(report, FindingKind::not_recomputed)) << said(report);
}

TEST(CheckRecording, FindsTicksThatWereExchanged) {
  const auto file = altered(one_touch(), "exchanged.rec", [](device::Recording& recording) {
    std::swap(recording.ticks[50].tick, recording.ticks[60].tick);
  });
  const auto report = checked(file, {waves(0.010)});
  EXPECT_TRUE(found(report, FindingKind::damage)) << said(report);
  EXPECT_NE(said(report).find("not in their order"), std::string::npos) << said(report);
}

TEST(CheckRecording, FindsATimeThatWasChanged) {
  const auto file =
      altered(one_touch(), "time.rec", [](device::Recording& recording) { recording.ticks[70].t_s += 1e-4; });
  const auto report = checked(file, {waves(0.010)});
  EXPECT_TRUE(found(report, FindingKind::damage)) << said(report);
  EXPECT_NE(said(report).find("contradict"), std::string::npos) << said(report);
}

/// The tick after the first that wrote a force comes `late_s` later than it did, and says so.
std::filesystem::path with_a_late_tick(std::string_view name, double late_s, std::uint32_t flags) {
  return altered(one_touch(), name, [&](device::Recording& recording) {
    auto& ticks = recording.ticks;
    const auto writes = [](const device::TouchSample& tick) { return norm(tick.written_force_N) > 0.05; };
    const auto held = std::find_if(ticks.begin() + 20, ticks.end() - 1, writes);
    ASSERT_NE(held, ticks.end() - 1);
    const auto late = held + 1;
    late->flags = (late->flags & ~haptics::flag::kStalled) | flags;
    late->dt_s += late_s;
    for (auto tick = late; tick != ticks.end(); ++tick) tick->t_s += late_s;
  });
}

TEST(CheckRecording, FindsAForceThatWasHeldWithoutATick) {
  for (const double late_s : {0.049, 0.499}) {
    const auto report = checked(with_a_late_tick("held.rec", late_s, 0), {});
    EXPECT_TRUE(found(report, FindingKind::held_force)) << said(report);
    EXPECT_FALSE(report.is_clean());
    EXPECT_FALSE(found(report, FindingKind::damage)) << said(report);
    const std::string text = said(report);
    EXPECT_NE(text.find(" N was held for "), std::string::npos) << text;
    EXPECT_NE(text.find(" ms without a tick"), std::string::npos) << text;
    for (const Finding& finding : report.findings)
      if (finding.kind == FindingKind::held_force) {
        EXPECT_GT(finding.size, 0.05);
        EXPECT_GE(finding.held_s, late_s);
      }
  }
  EXPECT_EQ(name_of(FindingKind::held_force), "held-force");
  EXPECT_EQ(unit_of(FindingKind::held_force), "N");
}

TEST(CheckRecording, AForceThatTheWatchdogCutWasNotHeld) {
  const auto report = checked(with_a_late_tick("cut.rec", 0.049, haptics::flag::kStalled), {});
  EXPECT_FALSE(found(report, FindingKind::held_force)) << said(report);
}

/// A replay of one_touch() that goes on after its end.
const std::filesystem::path& one_replay() {
  static const std::filesystem::path file = [] {
    auto options = recorded_touch_of(2.0, "one-replay.rec");
    options.device_url = "replay:" + one_touch().string();
    EXPECT_TRUE(touch_headless(makes({waves(0.010)}), options, {}));
    return options.recording;
  }();
  return file;
}

TEST(CheckRecording, FindsTimesOfAReplayThatWereChanged) {
  EXPECT_FALSE(found(checked(one_replay(), {}), FindingKind::damage)) << said(checked(one_replay(), {}));
  const auto later = altered(one_replay(), "later.rec", [](device::Recording& recording) {
    for (std::size_t n = 70; n < recording.ticks.size(); ++n) recording.ticks[n].t_s += 10.0;
  });
  EXPECT_NE(said(checked(later, {})).find("contradict"), std::string::npos) << said(checked(later, {}));
  const auto twice = altered(one_replay(), "twice.rec", [](device::Recording& recording) {
    for (auto& tick : recording.ticks) tick.t_s *= 2.0;
  });
  EXPECT_NE(said(checked(twice, {})).find("contradict"), std::string::npos) << said(checked(twice, {}));
}

TEST(CheckRecording, FindsATickOfTheHandThatHasTheNumberOfAnotherProbe) {
  // A writer would sort it out, so the bytes are changed.
  std::ifstream in(one_touch(), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto u32 = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  std::size_t at = 8;
  while (bytes.compare(at, 4, "TICK") != 0) at += 12 + u32(at + 4);
  constexpr std::size_t kProbe = 191;
  bytes[at + 12 + kProbe] = 3;
  const std::uint32_t crc = crc32(std::as_bytes(std::span(bytes).subspan(at + 12, u32(at + 4))));
  std::memcpy(bytes.data() + at + 8, &crc, sizeof crc);
  const auto file = in_temp("probe.rec");
  std::ofstream(file, std::ios::binary) << bytes;
  const auto report = checked(file, {});
  EXPECT_TRUE(found(report, FindingKind::damage)) << said(report);
  EXPECT_NE(said(report).find("the number of another probe"), std::string::npos) << said(report);
}

TEST(CheckRecording, SaysThatAForceIsNotAFiniteNumberInWords) {
  const auto file = altered(one_touch(), "not-finite.rec", [](device::Recording& recording) {
    recording.ticks[first_in_contact(recording)].written_force_N.v.y = std::nan("");
  });
  const std::string text = said(checked(file, {waves(0.010)}));
  EXPECT_NE(text.find("not a finite number"), std::string::npos) << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

/// A recording of ticks of exactly 1 ms, forged from one tick of a touch: the hand sinks 4 mm into a
/// spring of 500 N/m and is pushed out with twice the force that it pressed with.
void kick(device::Recording& recording) {
  constexpr int kTicks = 300;
  constexpr double kStiffness_N_per_m = 500.0;
  const device::TouchSample first = recording.ticks[first_in_contact(recording)];
  const auto depth_m = [](int n) { return 0.004 * std::sin(std::numbers::pi * (n - 50) / 200.0); };
  recording.ticks.clear();
  for (int n = 0; n < kTicks; ++n) {
    device::TouchSample tick = first;
    tick.tick = first.tick + static_cast<decltype(tick.tick)>(n);
    tick.t_s = first.t_s + 0.001 * n;
    tick.dt_s = 0.001;
    tick.device_position.v = {0.0, 0.0, -depth_m(n)};
    const bool pressed = depth_m(n) > 0.0 && n >= 50 && n <= 250;
    const double force_N = pressed ? kStiffness_N_per_m * depth_m(n) * (n >= 150 ? 2.0 : 1.0) : 0.0;
    tick.written_force_N.v = {0.0, 0.0, force_N};
    tick.flags = pressed ? haptics::flag::kContact : 0;
    recording.ticks.push_back(tick);
  }
}

/// The hand presses, and is 5 mm above the surface at the next reading that is believed, a new touch.
void jump_out(device::Recording& recording) {
  kick(recording);
  constexpr std::size_t kPressed = 100;
  recording.ticks.resize(kPressed + 1);
  auto& last = recording.ticks.back();
  last.device_position.v = {0.0, 0.0, 0.005};
  last.written_force_N.v = {};
  last.flags = haptics::flag::kNewTouch;
}

TEST(CheckRecording, FindsEnergyThatARecordingShows) {
  const auto report = checked(altered(one_touch(), "kick.rec", kick), {});
  EXPECT_TRUE(found(report, FindingKind::energy_made)) << said(report);
  const auto jump = checked(altered(one_touch(), "jump.rec", jump_out), {});
  EXPECT_TRUE(found(jump, FindingKind::energy_made)) << said(jump);
  // The spring took 4 mJ and gave 8; forces are held, and arrive a tick late, which adds 0.4.
  EXPECT_NEAR(report.work_made_max_J, 0.0044, 0.0002);
}

TEST(CheckRecording, ReadsWhatAnOlderProgramRecorded) {
  // Format 1: no traits, no options, no hash of the shape. Without damping, since the damper of such a
  // program did not look ahead.
  const auto file = in_temp("format-1.rec");
  auto options = recorded_touch_of(2.0, "averaged.rec");
  options.settings.law.law = haptics::Law::averaged;
  ASSERT_TRUE(touch_headless(makes({waves(0.010)}), options, {}));
  const auto recording = *device::read_recording(options.recording);
  auto writer = *device::RecordingWriter::create(
      file, R"({"format":1,"made_by":"palpable","seed":1,"rate_hz":1000.0})");
  for (auto scene : recording.scenes) {
    scene.json.erase(scene.json.find("\"shape_hash\""), 32);
    ASSERT_TRUE(writer->write(scene));
  }
  ASSERT_TRUE(writer->write(recording.ticks));
  ASSERT_TRUE(writer->finish(0));
  const auto report = checked(file, {waves(0.010)});
  EXPECT_EQ(report.recomputed, 0U);
  EXPECT_GT(report.law_recomputed, report.ticks / 2);
  EXPECT_EQ(report.differing, 0U) << said(report);
  // This law is not conservative, so energy may be found.
  EXPECT_FALSE(found(report, FindingKind::damage)) << said(report);
}

TEST(CheckRecording, SaysWhenTheSceneIsAnother) {
  const auto report = checked(one_touch(), {waves(0.011)});
  EXPECT_EQ(report.recomputed, 0U);
  EXPECT_NE(said(report).find("another scene was touched than the one given"), std::string::npos);
}

TEST(CheckRecording, RecomputesTheLawOnTheSecondSceneWhereTheFirstIsNotGiven) {
  auto options = recorded_touch_of(2.0, "second-scene.rec");
  ASSERT_TRUE(touch_headless(makes({waves(0.010), waves(0.012)}), options, {}));
  const auto report = checked(options.recording, {waves(0.012)});
  EXPECT_TRUE(report.is_clean()) << said(report);
  EXPECT_EQ(report.recomputed, 0U);
  EXPECT_GT(report.law_recomputed, report.ticks / 2) << said(report);
  EXPECT_EQ(report.differing, 0U);
  EXPECT_NE(said(report).find("only the law's force was recomputed: ticks before it could not be"),
            std::string::npos);
}

TEST(CheckRecording, RecomputesALawThatLooksAheadWhereTheFirstSceneIsNotGiven) {
  // Without friction the proxy's dampers depend on the delay and on the hand's expected motion, which are not
  // recorded.
  auto options = recorded_touch_of(3.0, "looks-ahead.rec");
  options.device_url = "sim:?speed-mm=200&delay=2&seed=5";
  options.settings.law.static_friction = 0.0;
  options.settings.law.damping_Ns_per_m = 1.0;
  const auto statistics = touch_headless(makes({waves(0.010), waves(0.012)}), options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  const auto report = checked(options.recording, {waves(0.012)});
  EXPECT_FALSE(found(report, FindingKind::law_force) || found(report, FindingKind::free_air)) << said(report);
  EXPECT_EQ(report.recomputed, 0U);
  EXPECT_GT(report.law_recomputed, report.ticks / 2) << said(report);
  EXPECT_EQ(report.differing, 0U);
  EXPECT_LE(report.work_made_max_J, statistics->servo.touch.made_max_J) << "the touch says no less";
}

TEST(CheckRecording, StatesTheEnergiesThatTheTouchStated) {
  auto options = recorded_touch_of(2.0, "energies.rec");
  options.device_url = "sim:?speed-mm=200&seed=3";
  const auto statistics = touch_headless(makes({waves(0.010)}), options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  const haptics::TickCounts& touch = statistics->servo.touch;
  const auto report = checked(options.recording, {waves(0.010)});
  ASSERT_EQ(report.recomputed, report.ticks) << said(report);
  EXPECT_EQ(report.made_max_J, touch.made_max_J);
  EXPECT_EQ(report.made_max_without_controller_J, touch.made_max_without_controller_J);
  EXPECT_EQ(report.work_made_max_J, touch.work_made_max_J);
  EXPECT_EQ(report.work_since_zero_force_max_J, touch.work_since_zero_force_max_J);
  EXPECT_LE(report.work_made_max_J, report.made_max_J);
}

TEST(CheckRecording, StatesWhatChangesBroughtAsTheTouchDid) {
  auto options = recorded_touch_of(2.0, "changes.rec");
  options.settings.law.law = haptics::Law::penalty;
  const auto statistics = touch_headless(makes({waves(0.010), waves(0.014), waves(0.010)}), options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  const auto report = checked(options.recording, {waves(0.010), waves(0.014)});
  ASSERT_EQ(report.recomputed, report.ticks) << said(report);
  EXPECT_EQ(report.scene_change_J, statistics->servo.touch.scene_change_J);
  EXPECT_TRUE(std::isnan(checked(options.recording, {}).scene_change_J));
}

TEST(CheckRecording, StatesNoWorkAloneWithTorqueAndForTracingAsTheTouchDoes) {
  const auto no_work = [](HeadlessOptions options, const std::shared_ptr<const models::Scene>& scene) {
    const auto statistics = touch_headless(makes({scene}), options, {});
    ASSERT_TRUE(statistics) << statistics.error().sentence();
    EXPECT_TRUE(std::isnan(statistics->servo.touch.work_made_max_J));
    EXPECT_TRUE(std::isnan(statistics->servo.touch.work_since_zero_force_max_J));
    const auto report = checked(options.recording, {scene});
    EXPECT_EQ(report.recomputed, report.ticks) << said(report);
    EXPECT_TRUE(std::isnan(report.work_made_max_J));
    EXPECT_TRUE(std::isnan(report.work_since_zero_force_max_J));
  };
  auto with_torque = recorded_touch_of(0.5, "torque-work.rec");
  with_torque.device_url = "sim:?torque=1&seed=3";
  no_work(with_torque, waves(0.010));
  Raster<models::BoundaryPixel> edges(100, 80);
  for (int x = 10; x < 90; ++x) edges(x, 40) = {1.0F, 0.0F};
  models::Scene lines;
  lines.model = std::make_shared<const models::Contours>(
      models::Contours{*models::BoundaryMap::from_edges(std::move(edges), 0.001, 2.0, {}, Work{}),
                       models::relief_of(hilly_scene(0.004))});
  const auto traced = std::make_shared<const models::Scene>(std::move(lines));
  for (const double bounds : {1.0, 0.0}) {
    auto tracing = recorded_touch_of(0.5, "tracing-work.rec");
    tracing.settings.law.law = haptics::Law::tracing;
    tracing.settings.law.tracing_bounds = bounds;
    no_work(tracing, traced);
  }
}

TEST(CheckRecording, CanBeStopped) {
  std::atomic<bool> stop{true};
  Work work;
  work.cancel = &stop;
  const auto report = check_recording(one_touch(), {}, work);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::interrupted);
}

TEST(Replay, OfARecordingGivesItsForcesToTheLastBit) {
  auto options = recorded_touch_of(2.5, "replayed.rec");
  options.device_url = "replay:" + one_touch().string();
  ASSERT_TRUE(touch_headless(makes({waves(0.010)}), options, {}));
  const auto first = *device::read_recording(one_touch());
  const auto again = *device::read_recording(options.recording);
  const std::size_t count = std::min(first.ticks.size(), again.ticks.size());
  ASSERT_GT(count, 100U);
  for (std::size_t n = 0; n < count; ++n) ASSERT_EQ(again.ticks[n], first.ticks[n]) << n;
}

}  // namespace
}  // namespace palpable::session
