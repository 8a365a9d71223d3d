// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>

#include "program.hpp"
#include "test_pictures.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class Touch : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write_pair(folder_.string(), textured_pair());
  }
};

TEST_F(Touch, WithoutAPageMeasuresItself) {
  const Outcome outcome =
      palpable({"touch", path("left.png"), path("right.png"), "--headless", "--seconds", "2", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = outcome.json();
  for (const char* field : {"ticks", "rate_hz", "missed", "period_us", "compute_us"})
    EXPECT_TRUE(json["servo"].contains(field)) << field;
  EXPECT_TRUE(json["force"].contains("max_N"));
  EXPECT_TRUE(json["force"].contains("clamped_ticks"));
  EXPECT_TRUE(json["energy"].contains("made_max_J"));
  EXPECT_GT(json["contact_ticks"], 0);
  EXPECT_EQ(json["allocations_in_ticks"], 0);
  EXPECT_TRUE(json["seconds_to_first_force"].is_number());
  EXPECT_TRUE(json.contains("realtime_priority"));
  EXPECT_THAT(json["device"].get<std::string>(), HasSubstr("sim"));
}

TEST_F(Touch, WithoutInputUsesTheSample) {
  const Outcome outcome = palpable({"touch", "--headless", "--seconds", "0.5", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(outcome.json()["servo"]["ticks"], 0);
}

TEST_F(Touch, RecordsTheTouch) {
  const Outcome outcome = palpable({"touch", path("left.png"), path("right.png"), "--headless", "--seconds",
                                    "1", "--record", path("touch.rec"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(std::filesystem::file_size(path("touch.rec")), 1000U);
}

TEST_F(Touch, AsPublishedUsesAPapersLawAndRate) {
  const Outcome shi = palpable({"touch", path("left.png"), path("right.png"), "--headless", "--seconds", "1",
                                "--as-published", "shi", "--record", path("shi.rec"), "--json"});
  ASSERT_EQ(shi.exit_code, 0) << shi.err;
  const auto recorded = read_text(path("shi.rec"));
  EXPECT_THAT(recorded, HasSubstr("\"as_published\":\"shi\""));
  EXPECT_THAT(recorded, HasSubstr("\"rate_hz\":500"));
  EXPECT_THAT(recorded, HasSubstr("sobel"));
}

TEST_F(Touch, OptionsApplyToTheSample) {
  EXPECT_EQ(palpable({"touch", "--headless", "--seconds", "0.2", "--size", "nonsense"}).exit_code, 2);
  const Outcome published =
      palpable({"touch", "--headless", "--seconds", "0.2", "--method", "fast", "--as-published", "shi"});
  EXPECT_EQ(published.exit_code, 0) << published.err;
  EXPECT_THAT(published.err, HasSubstr("The paper does not state the height"));
}

TEST_F(Touch, AsPublishedByMoustakasStoresDistanceAndForceInADenseField) {
  write_text(
      path("ball.json"),
      R"({"primitives": [{"size_m": [0.02, 0.02, 0.02], "exponents": [1, 1], "position_m": [0, 0, 0]}]})");
  const Outcome touched =
      palpable({"touch", path("ball.json"), "--resolution", "32", "--headless", "--seconds", "1",
                "--as-published", "moustakas", "--record", path("m.rec"), "--json"});
  ASSERT_EQ(touched.exit_code, 0) << touched.err;
  const auto recorded = read_text(path("m.rec"));
  EXPECT_THAT(recorded, HasSubstr("\"as_published\":\"moustakas\""));
  EXPECT_THAT(recorded, HasSubstr("penalty"));
  const Outcome made = palpable(
      {"make", path("ball.json"), "--resolution", "32", "--as-published", "moustakas", "-o", path("m.palp")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(palpable({"info", path("m.palp"), "--json"}).json()["kind"], "dense-field");
  const Outcome again =
      palpable({"touch", path("m.palp"), "--headless", "--seconds", "0.5", "--as-published", "moustakas"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

TEST_F(Touch, AsPublishedByParkIsFeltAgainFromItsSavedGrid) {
  const std::string sample = PALPABLE_SAMPLES "/sculpture_";
  const Outcome made =
      palpable({"make", sample + "left.png", sample + "right.png", "--calibration", sample + "calib.txt",
                "--as-published", "park", "--grid-points", "60", "-o", path("park.palp")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("is a product"));
  EXPECT_EQ(palpable({"info", path("park.palp"), "--json"}).json()["kind"], "grid");
  const Outcome again =
      palpable({"touch", path("park.palp"), "--headless", "--seconds", "0.5", "--as-published", "park"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

TEST_F(Touch, LimitsAreOffOnlyAsPublished) {
  const Outcome ours = palpable(
      {"touch", path("left.png"), path("right.png"), "--headless", "--seconds", "0.2", "--unlimited"});
  EXPECT_EQ(ours.exit_code, 2);
  EXPECT_THAT(ours.err, HasSubstr("--as-published"));
}

TEST_F(Touch, CheckRecomputesWhatWasRecordedAndFindsWhatWasChanged) {
  const Outcome made =
      palpable({"make", path("left.png"), path("right.png"), "--method", "fast", "-o", path("scene.palp")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Outcome touched = palpable(
      {"touch", path("scene.palp"), "--headless", "--seconds", "1", "--record", path("check.rec"), "--json"});
  ASSERT_EQ(touched.exit_code, 0) << touched.err;
  // The scene is the one that the recorded command names.
  const Outcome checked = palpable({"check", path("check.rec"), "--json"});
  ASSERT_EQ(checked.exit_code, 0) << checked.out;
  EXPECT_TRUE(checked.json()["clean"]);
  EXPECT_EQ(checked.json()["recomputed"]["ticks"], checked.json()["ticks"]);
  auto bytes = read_text(path("check.rec"));
  bytes[bytes.size() / 2] ^= 1;
  write_text(path("changed.rec"), bytes);
  const Outcome changed = palpable({"check", path("changed.rec"), path("scene.palp")});
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_THAT(changed.out, HasSubstr("the file is damaged"));
  const Outcome exported = palpable({"export", path("changed.rec"), "-o", path("changed.csv")});
  EXPECT_EQ(exported.exit_code, 3);
  EXPECT_THAT(exported.err, HasSubstr("is a recording that is damaged after"));
  EXPECT_FALSE(std::filesystem::exists(path("changed.csv")));
  write_text(path("cut.rec"), read_text(path("check.rec")).substr(0, bytes.size() * 2 / 3));
  const Outcome cut = palpable({"check", path("cut.rec"), path("scene.palp")});
  EXPECT_EQ(cut.exit_code, 0) << cut.out;
  EXPECT_THAT(cut.out, HasSubstr("the recording was cut off there"));
  EXPECT_THAT(cut.out, Not(HasSubstr("\nClean.")));
  EXPECT_EQ(palpable({"check", path("scene.palp")}).exit_code, 3);
}

TEST_F(Touch, PrintsItsMeasurementsWhenInterrupted) {
  Running running({"touch", path("left.png"), path("right.png"), "--headless", "--seconds", "60", "--json"});
  ASSERT_TRUE(running.catches(SIGINT, std::chrono::seconds(60)));
  running.send(SIGINT);
  const Outcome outcome = running.wait(std::chrono::seconds(20));
  EXPECT_EQ(outcome.exit_code, 130);
}

TEST_F(Touch, EndsAtOnceWhenInterruptedTwice) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Running running({"touch", path("left.png"), path("right.png"), "--headless", "--seconds", "60"});
    ASSERT_TRUE(running.catches(signal, std::chrono::seconds(60)));
    running.send(signal);
    running.send(signal);
    const Outcome outcome = running.wait(std::chrono::seconds(20));
    // The system merges two signals that arrive together.
    EXPECT_TRUE(outcome.exit_code == 1000 + signal || outcome.exit_code == 130) << outcome.exit_code;
  }
}

TEST_F(Touch, GoesOnWithoutItsTerminalIfStartedByNohup) {
  Running running({"touch", path("left.png"), path("right.png"), "--headless", "--seconds", "1"}, "/dev/null",
                  {}, Hangup::ignored);
  ASSERT_TRUE(running.catches(SIGINT, std::chrono::seconds(60)));
  running.send(SIGHUP);
  EXPECT_EQ(running.wait(std::chrono::seconds(60)).exit_code, 0);
}

TEST_F(Touch, ServesThePageAndPrintsItsAddress) {
  Running running({"touch", path("left.png"), path("right.png"), "--no-browser"});
  EXPECT_TRUE(running.says("http://127.0.0.1:", std::chrono::seconds(20))) << running.err();
  EXPECT_TRUE(running.says("lets one browser in, once", std::chrono::seconds(20))) << running.err();
  running.send(SIGTERM);
  const Outcome outcome = running.wait(std::chrono::seconds(20));
  EXPECT_EQ(outcome.exit_code, 130);
}

TEST_F(Touch, SharesThePageIfAskedTo) {
  Running running({"touch", path("left.png"), path("right.png"), "--no-browser", "--share", "--share-address",
                   "127.0.0.1"});
  EXPECT_TRUE(running.says("Let one phone or tablet touch: https://127.0.0.1:", std::chrono::seconds(20)))
      << running.err();
  EXPECT_TRUE(running.says("SHA-256", std::chrono::seconds(20))) << running.err();
  running.send(SIGTERM);
  EXPECT_EQ(running.wait(std::chrono::seconds(20)).exit_code, 130);
}

TEST_F(Touch, RefusesToShareWhatIsNoPageOrAtAForeignAddress) {
  const std::string left = path("left.png"), right = path("right.png");
  EXPECT_EQ(palpable({"touch", left, right, "--share", "--headless"}).exit_code, 2);
  EXPECT_EQ(palpable({"touch", left, right, "--share-port", "4711"}).exit_code, 2);
  const Outcome foreign =
      palpable({"touch", left, right, "--no-browser", "--share", "--share-address", "203.0.113.7"});
  EXPECT_EQ(foreign.exit_code, 3);
  EXPECT_THAT(foreign.err, HasSubstr("203.0.113.7"));
}

TEST_F(Touch, LooksForAHeadByADepthCameraAndForThePageOnly) {
  const std::string left = path("left.png"), right = path("right.png");
  const Outcome headless =
      palpable({"touch", left, right, "--head", "openni:9", "--headless", "--seconds", "0.1", "--json"});
  EXPECT_EQ(headless.exit_code, 0) << headless.err;
  EXPECT_THAT(headless.err, HasSubstr("--head has no effect without the page"));
  for (const char* other : {"http://127.0.0.1/video", "robot:127.0.0.1", "a folder"}) {
    const Outcome refused = palpable({"touch", left, right, "--no-browser", "--head", other});
    EXPECT_EQ(refused.exit_code, 2) << other << refused.err;
  }
}

TEST_F(Touch, AnUnknownDeviceIsReported) {
  const Outcome unknown =
      palpable({"touch", path("left.png"), path("right.png"), "--headless", "--device", "teapot:"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(unknown.err));
  EXPECT_THAT(unknown.err, HasSubstr("teapot"));
  const Outcome law =
      palpable({"touch", path("left.png"), path("right.png"), "--headless", "--law", "gravity"});
  EXPECT_EQ(law.exit_code, 2);
  EXPECT_THAT(law.err, HasSubstr("gravity"));
}

TEST_F(Touch, OptionAsSelectsTheKindOfScene) {
  const Outcome outcome = palpable({"touch", path("left.png"), path("right.png"), "--as", "grid",
                                    "--grid-points", "40", "--radius", "0", "--law", "grid", "--headless",
                                    "--seconds", "0.2", "--record", path("touch.rec")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(read_text(path("touch.rec")), HasSubstr("\"law\":\"grid\""));
}

TEST_F(Touch, ShowsProgressInOneLine) {
  write_pair(folder_.string(), textured_pair(400, 300));
  const Outcome outcome = palpable_on_a_terminal({"make", path("left.png"), path("right.png"), "-o",
                                                  path("a.palp"), "--method", "best", "--threads", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(" %"));
  // Each step overwrites the previous one, and none is left at the end. Notes follow, which may state per
  // cent.
  const std::string progress = outcome.err.substr(0, outcome.err.rfind("\r\x1b[K"));
  EXPECT_THAT(progress, EndsWith(" %"));
  EXPECT_EQ(progress.find('\n'), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace palpable::test
