// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/browser_touch.hpp"

#include "palpable/onefile/page_talk.hpp"
#include "palpable/onefile/test_scenes.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palpable::onefile {
namespace {

using nlohmann::json;

/// A page with its touch, and the messages that it has been sent.
class TalkWithATouch : public ::testing::Test {
 protected:
  TalkWithATouch() {
    auto opened = BrowserTouch::open(std::make_shared<const models::Scene>(hills_scene()));
    EXPECT_TRUE(opened);
    touch = *std::move(opened);
    talk = std::make_unique<PageTalk>(*touch);
    take();
  }

  void take() {
    while (const auto frame = talk->take())
      (frame->binary ? rasters : messages)
          .push_back(frame->binary ? json(frame->bytes.size()) : json::parse(frame->bytes));
  }
  void send(const json& message) {
    talk->receive(message.dump());
    take();
  }
  bool run(double seconds) {
    constexpr double kFrame_s = 0.016;
    bool moves = false;
    for (double t = 0.0; t < seconds; t += kFrame_s) {
      moves = talk->advance(kFrame_s);
      take();
    }
    return moves;
  }
  json last(const std::string& type) const {
    const auto found =
        std::find_if(messages.rbegin(), messages.rend(), [&](const json& m) { return m["type"] == type; });
    return found == messages.rend() ? json() : *found;
  }
  json first_probe() const { return last("state").value("probes", json::array()).at(0); }
  void press(double x_m, double press_m, int probe = 0) {
    send({{"type", "pointer"}, {"probe", probe}, {"x_m", x_m}, {"y_m", 0.0}, {"press_m", press_m}});
  }

  std::unique_ptr<BrowserTouch> touch;
  std::unique_ptr<PageTalk> talk;
  std::vector<json> messages, rasters;
};

TEST_F(TalkWithATouch, BeginsWithEverythingThatThePageNeeds) {
  std::vector<std::string> types;
  for (const json& message : messages) types.push_back(message["type"]);
  EXPECT_EQ(types, (std::vector<std::string>{"hello", "laws", "scene", "settings", "materials"}));
  // Heights and picture.
  EXPECT_EQ(rasters.size(), 2U);
  EXPECT_EQ(last("scene")["name"], "Hills & <dales>");
  EXPECT_TRUE(last("hello")["pointer_moves"]);
  EXPECT_EQ(last("settings")["law"], "proxy");
  EXPECT_EQ(last("materials")["materials"][1]["name"], "stone <wall>");
}

TEST_F(TalkWithATouch, GivesTheForceOfAPressedProbe) {
  press(0.0, -0.002);
  run(0.5);
  EXPECT_FALSE(first_probe()["contact"]);
  press(0.0, 0.001);
  run(1.0);
  EXPECT_TRUE(first_probe()["contact"]);
  // One millimetre deep at 500 N/m, on a slope.
  EXPECT_NEAR(first_probe()["fz_N"].get<double>(), 0.5, 0.15);
  press(0.0, -0.002);
  run(0.5);
  EXPECT_FALSE(first_probe()["contact"]);
  EXPECT_EQ(first_probe()["fz_N"], 0.0);
}

TEST_F(TalkWithATouch, ComesToRestAndWakesUp) {
  press(0.0, 0.001);
  EXPECT_TRUE(run(0.5));
  EXPECT_FALSE(run(3.0));
  press(0.002, 0.001);
  EXPECT_TRUE(run(0.1));
}

TEST_F(TalkWithATouch, HasTenProbesThatComeAndGo) {
  press(0.0, 0.001);
  press(0.004, 0.001, 9);
  run(0.5);
  EXPECT_EQ(last("state")["probes"].size(), 2U);
  EXPECT_EQ(last("state")["probes"][1]["probe"], 9);
  send({{"type", "lift"}, {"probe", 9}});
  run(1.0);
  EXPECT_EQ(last("state")["probes"].size(), 1U);
}

TEST_F(TalkWithATouch, AnswersInTheProgramsWords) {
  const auto ask = [&](const std::string& what) {
    send({{"type", "ask"},
          {"serial", 5},
          {"what", what},
          {"probe", 0},
          {"x_m", 0.0},
          {"y_m", 0.0},
          {"press_m", 0.0},
          {"part", 0}});
    return last("words")["text"].get<std::string>();
  };
  EXPECT_NE(ask("opening").find("They are of stone."), std::string::npos);
  EXPECT_NE(ask("scene"), "");
  EXPECT_NE(ask("position"), "");
  EXPECT_EQ(last("words")["serial"], 5);
}

TEST_F(TalkWithATouch, ChangesLawHeightAndMaterialsAtOnce) {
  send({{"type", "change"},
        {"serial", 7},
        {"law", "penalty"},
        {"parameters", json::array()},
        {"height_factor", 2.0}});
  run(0.5);
  EXPECT_EQ(last("settings")["law"], "penalty");
  EXPECT_EQ(last("settings")["height_factor"], 2.0);
  EXPECT_EQ(last("settings")["answers"], 7);
  json edit{{"stiffness_N_per_m", 250.0},
            {"damping_Ns_per_m", nullptr},
            {"friction", nullptr},
            {"stickiness", nullptr},
            {"texture", nullptr}};
  send({{"type", "edit"}, {"serial", 8}, {"label", 0}, {"material", edit}});
  run(0.5);
  EXPECT_EQ(last("materials")["materials"][0]["material"]["stiffness_N_per_m"], 250.0);
  press(0.0, 0.001);
  run(1.0);
  EXPECT_TRUE(first_probe()["contact"]);
}

TEST_F(TalkWithATouch, SaysWhyAChangeIsNotCarriedOut) {
  send({{"type", "change"},
        {"serial", 9},
        {"law", "no-law"},
        {"parameters", json::array()},
        {"height_factor", 1.0}});
  run(0.1);
  EXPECT_EQ(last("notice")["text"], "no-law: there is no such law");
  EXPECT_EQ(last("settings")["answers"], 9);
  EXPECT_EQ(last("settings")["law"], "proxy");
}

TEST_F(TalkWithATouch, GivesNoForceWhilePaused) {
  press(0.0, 0.001);
  run(1.0);
  ASSERT_GT(first_probe()["fz_N"].get<double>(), 0.1);
  send({{"type", "pause"}, {"paused", true}});
  run(0.5);
  EXPECT_EQ(first_probe()["fz_N"], 0.0);
  EXPECT_TRUE(last("settings")["paused"]);
}

TEST_F(TalkWithATouch, IgnoresWhatIsNoMessage) {
  talk->receive("{\"type\": \"pointer\"}");
  talk->receive("no JSON");
  EXPECT_EQ(talk->take(), nullptr);
}

TEST(BrowserTouch, TouchesEveryKindOfScene) {
  for (const models::Scene& scene : scenes_of_all_kinds()) {
    auto touch = BrowserTouch::open(std::make_shared<const models::Scene>(scene));
    ASSERT_TRUE(touch) << models::kind_of(scene.model);
    (*touch)->move({0, 0.0, 0.0, 0.002});
    (*touch)->advance(0.05);
    EXPECT_EQ((*touch)->state().probes.size(), 1U);
  }
}

}  // namespace
}  // namespace palpable::onefile
