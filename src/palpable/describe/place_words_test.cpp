// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/place_words.hpp"

#include "palpable/describe/place_guide.hpp"
#include "palpable/describe/test_scenes.hpp"

#include <numbers>

namespace palpable::describe {
namespace {

TEST(PlaceWords, NameTheNinths) {
  EXPECT_EQ(region_words({0.0, 0.0}, 0.1, 0.1), "centre");
  EXPECT_EQ(region_words({-0.04, 0.04}, 0.1, 0.1), "upper left");
  EXPECT_EQ(region_words({0.04, 0.0}, 0.1, 0.1), "middle right");
  EXPECT_EQ(region_words({0.0, -0.04}, 0.1, 0.1), "lower middle");
}

TEST(PlaceWords, CountMillimetres) {
  EXPECT_EQ(offset_words(-0.032, 0.001), "32 millimetres left, 1 millimetre up");
  EXPECT_EQ(offset_words(0.0004, -0.0004), "here");
  EXPECT_EQ(from_middle_words({0.0, 0.0}), "at the middle");
}

TEST(PlaceWords, SayWhichWayItRises) {
  EXPECT_EQ(slope_words(0.0, 0.0), "level");
  EXPECT_EQ(slope_words(0.3, 0.3), "rising to the upper right");
  EXPECT_EQ(slope_words(-2.0, 0.1), "rising steeply to the left");
  EXPECT_EQ(slope_words(0.0, -0.1), "rising gently to the bottom");
}

TEST(PlaceWords, SayTurnsBelowAnEighthInDegrees) {
  const auto facing = [](double degrees) { return heading_words(degrees * std::numbers::pi / 180.0); };
  EXPECT_EQ(facing(0.0), "up");
  EXPECT_EQ(facing(15.0), "up, turned 15 degrees left");
  EXPECT_EQ(facing(-15.0), "up, turned 15 degrees right");
  EXPECT_EQ(facing(45.0), "up and left");
  EXPECT_EQ(facing(60.0), "left, turned 30 degrees right");
  EXPECT_EQ(facing(-90.0), "right");
  EXPECT_EQ(facing(181.0), "down, turned 1 degree left");
  EXPECT_EQ(facing(359.7), "up");
  EXPECT_EQ(facing(345.0), "up, turned 15 degrees right");
  EXPECT_EQ(facing(720.0 + 90.0), "left");
}

TEST(PlaceWords, LinesHaveNoSign) {
  for (const double turn : {0.0, std::numbers::pi, -std::numbers::pi}) {
    EXPECT_EQ(line_words(turn), "from left to right");
    EXPECT_EQ(line_words(turn + 0.25 * std::numbers::pi), "from lower left to upper right");
    EXPECT_EQ(line_words(turn + 0.5 * std::numbers::pi), "up and down");
    EXPECT_EQ(line_words(turn + 0.75 * std::numbers::pi), "from upper left to lower right");
  }
}

TEST(PlaceWords, SayHeightSlopeAndNameOfAPlace) {
  const auto scene = named_hills();
  EXPECT_EQ(
      position_words(scene, 1.0, {-0.03, 0.02}, PlaceGuide(scene)),
      "Upper left, 30 millimetres left, 20 millimetres up from the middle. Height 13 millimetres, level. "
      "Tall hill.");
  EXPECT_EQ(step_words(scene, 1.0, {-0.03, 0.02}), "tall hill, 13 millimetres, level");
  EXPECT_EQ(step_words(scene, 2.0, {-0.03, 0.02}), "tall hill, 26 millimetres, level");
  EXPECT_EQ(
      felt_words(scene, 1.0, {-0.03, 0.02}, 0.254),
      "upper left, 30 millimetres left, 20 millimetres up from the middle, height 13 millimetres, force "
      "0.25 newtons, tall hill");
}

TEST(PlaceWords, OfContoursSayTheLine) {
  const auto scene = circle_and_line();
  EXPECT_EQ(step_words(scene, 1.0, {0.0, -0.02}), "on the line, from left to right");
  EXPECT_EQ(step_words(scene, 1.0, {-0.04, 0.02}), "on the line, up and down");
  EXPECT_EQ(step_words(scene, 1.0, {0.0, -0.03}), "beside the line, 10 millimetres up");
  EXPECT_EQ(step_words(scene, 1.0, {0.045, 0.0}), "no line near here");
}

/// A ball with a radius of 5 mm.
models::Scene ball() {
  const models::Lattice lattice{{-0.008, -0.008, -0.008}, 0.001, {17, 17, 17}};
  std::vector<float> distances_m;
  for (int z = 0; z < 17; ++z)
    for (int y = 0; y < 17; ++y)
      for (int x = 0; x < 17; ++x)
        distances_m.push_back(static_cast<float>(norm(lattice.place_m(x, y, z)) - 0.005));
  models::Scene scene = two_hills();
  scene.pose = models::SolidPose::flat;
  scene.model = std::make_shared<const models::FieldOnLattice>(
      *models::field_of(*models::DenseField::from(lattice, models::DenseContent::distance,
                                                  std::move(distances_m), {0.0, 2e-5, 3e-5}),
                        {-0.005, -0.005, -0.005}, {0.005, 0.005, 0.005}));
  return scene;
}

TEST(PlaceWords, SayThatNothingIsBesideASolidAndThatItCannotBePressed) {
  const auto scene = ball();
  EXPECT_EQ(press_words(scene, {}, 0.0015), "pressed 1.5 millimetres deep");
  EXPECT_NE(step_words(scene, 1.0, {}), "nothing here");
  const Place beside{0.0049, 0.0049};
  const std::string nothing = "nothing here, the surface is 1.5 millimetres left, 1.5 millimetres down";
  EXPECT_EQ(step_words(scene, 1.0, beside), nothing);
  EXPECT_EQ(press_words(scene, beside, 0.0015), "nothing to press: " + nothing);
  EXPECT_EQ(press_words(scene, beside, -0.001), "lifted by 1 millimetre");
}

TEST(PlaceWords, SayHowDeepAPressIs) {
  const auto scene = named_hills();
  EXPECT_EQ(press_words(scene, {}, 0.0015), "pressed 1.5 millimetres deep");
  EXPECT_EQ(press_words(scene, {}, -0.001), "lifted by 1 millimetre");
}

}  // namespace
}  // namespace palpable::describe
