// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/key_probe.hpp"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Name = TerminalKey::Name;
using Request = KeyProbe::Request;

/// A plate of 100 x 100 mm, 1 mm high, whose right half is 5 mm high.
models::Scene step_scene() {
  Raster<float> heights(100, 100, 0.001F);
  for (int y = 0; y < 100; ++y)
    for (int x = 50; x < 100; ++x) heights(x, y) = 0.005F;
  models::Scene scene;
  scene.model =
      std::make_shared<const models::Relief>(*models::Relief::from_samples(std::move(heights), 0.001));
  scene.title = "Step";
  return scene;
}

class Exploring : public testing::Test {
 protected:
  std::string press(const TerminalKey& key) {
    std::string words;
    request = probe.press(key, scene, 1.0, words);
    return words;
  }
  std::string press(char character) { return press(TerminalKey{Name::character, character}); }

  models::Scene scene = step_scene();
  KeyProbe probe;
  Request request = Request::nothing;
};

TEST_F(Exploring, SaysHeightAndSlopeOfEachStep) {
  for (int k = 0; k < 9; ++k) press({Name::right});
  EXPECT_EQ(press({Name::right}), "5 millimetres, level.");
  for (int k = 0; k < 3; ++k) press({Name::left, '\0', true});
  EXPECT_EQ(press({Name::left, '\0', true}), "1 millimetre, level.");
}

TEST_F(Exploring, TakesStepsOfTheScenesSize) {
  Raster<float> heights(100, 100, 0.0002F);
  scene.model =
      std::make_shared<const models::Relief>(*models::Relief::from_samples(std::move(heights), 0.00002));
  press({Name::right});
  EXPECT_NEAR(probe.hand(scene, {}).v.x, 0.00002, 1e-9);
  press({Name::page_down});
  session::TouchSettings settings;
  settings.law.radius_m = 0.0;
  EXPECT_NEAR(probe.hand(scene, settings).v.z, 0.0002 - 0.2 * 0.002, 1e-6);
  EXPECT_THAT(press('h'), HasSubstr("0.1 millimetres"));
}

TEST_F(Exploring, SaysTheRim) {
  for (int k = 0; k < 10; ++k) press({Name::right, '\0', true});
  EXPECT_EQ(press({Name::right}), "Rim of the scene, 5 millimetres, level.");
}

TEST_F(Exploring, DescribesMoreOnAskingAgainAndBeginsAnewAfterAnotherKey) {
  const std::string brief = press('d');
  EXPECT_THAT(brief, StartsWith("Step. 100 by 100 millimetres"));
  EXPECT_THAT(press('d'), StartsWith("From the probe to the highest point"));
  press('p');
  EXPECT_EQ(press('d'), brief);
}

TEST_F(Exploring, SaysWhereItIs) { EXPECT_THAT(press('p'), HasSubstr("at the middle. Height ")); }

TEST_F(Exploring, PressesAndLiftsTheHand) {
  const session::TouchSettings settings;
  const double before_m = probe.hand(scene, settings).v.z;
  EXPECT_EQ(press({Name::page_down}), "Pressed 2 millimetres deep.");
  EXPECT_NEAR(probe.hand(scene, settings).v.z, before_m - 0.0005, 1e-12);
  for (int k = 0; k < 5; ++k) press({Name::page_up});
  EXPECT_EQ(press({Name::page_up}), "Lifted by 1 millimetre.");
}

TEST_F(Exploring, AsksToPauseAndToEnd) {
  press(' ');
  EXPECT_EQ(request, Request::pause);
  press('q');
  EXPECT_EQ(request, Request::end);
  press('x');
  EXPECT_EQ(request, Request::nothing);
}

}  // namespace
}  // namespace palpable::cli
