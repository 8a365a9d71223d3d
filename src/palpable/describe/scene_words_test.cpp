// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/scene_words.hpp"

#include "palpable/describe/test_scenes.hpp"

#include <gmock/gmock.h>

namespace palpable::describe {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(SceneWords, NameASceneByItsTitleElseByItsFiles) {
  models::Scene scene = two_hills();
  EXPECT_EQ(name_of(scene), "twin.png");
  scene.source.inputs = {"a/A.png", "b/B.png"};
  EXPECT_EQ(name_of(scene), "A.png and B.png");
  EXPECT_EQ(opening_words(scene),
            "Ready to touch: A.png and B.png. Press D to hear what is where, H for help.");
  scene.title = "Two hills";
  scene.description = "Seen from the south";
  EXPECT_EQ(opening_words(scene),
            "Ready to touch: Two hills. Seen from the south. Press D to hear what is where, H for help.");
}

TEST(SceneWords, CountObjectsFirstAndGiveDetailsOnRequest) {
  const auto parts = scene_parts(two_hills(), 1.0, {});
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0],
            "twin.png. 100 by 75 millimetres, heights from 1 to 13 millimetres. 2 objects rise above the "
            "ground: upper "
            "left; lower right.");
  EXPECT_EQ(
      parts[1],
      "From the probe to the highest point: 30 millimetres left, 20 millimetres up. Upper left: top at 13 "
      "millimetres, 30 millimetres left, 20 millimetres up from the middle. Lower right: top at 9 "
      "millimetres, 25 millimetres right, 15 millimetres down from the middle.");
  EXPECT_THAT(parts[2], StartsWith("Average heights in millimetres. Upper third, left to right:"));
}

TEST(SceneWords, SayHowManyPeaksAreTooSmallToBeObjects) {
  // A lake and a village of twelve houses of 1 x 1 mm.
  const auto scene = surface_scene([](double x, double y) {
    if (std::hypot(x + 0.02, y) < 0.02) return 0.002;
    const double u = x - 0.03, v = y - 0.02;
    const bool in_village = u > 0.0 && u < 0.016 && v > 0.0 && v < 0.012;
    return in_village && std::fmod(u, 0.004) < 0.001 && std::fmod(v, 0.004) < 0.001 ? 0.002 : 0.001;
  });
  const auto parts = scene_parts(scene, 1.0, {});
  EXPECT_THAT(parts[0],
              HasSubstr("1 object rises above the ground: middle left. 12 smaller ones, upper right."));
}

TEST(SceneWords, SayThatTheGroundIsTiltedInsteadOfCountingItsEdge) {
  const auto scene =
      surface_scene([](double x, double y) { return 0.005 + 0.06 * x + bump(x, y, -0.03, 0.02, 0.005); });
  EXPECT_THAT(scene_parts(scene, 1.0, {})[0],
              HasSubstr("The ground is tilted, rising gently to the right. 1 object rises above the ground: "
                        "upper left."));
}

TEST(SceneWords, CountObjectsThatAreLowBesideTheTiltOfTheirGround) {
  // A ground that rises by 15 mm, with a high bump where it is low and a low one where it is high.
  const auto scene = surface_scene([](double x, double y) {
    return 0.01 + 0.15 * x + bump(x, y, -0.03, 0.02, 0.0009) + bump(x, y, 0.025, -0.015, 0.0006);
  });
  const auto parts = scene_parts(scene, 1.0, {});
  EXPECT_THAT(parts[0], HasSubstr("2 objects rise above the ground: upper left; lower right."));
  EXPECT_THAT(parts[1], StartsWith("From the probe to the highest point above the tilted ground: 30 "
                                   "millimetres left, 20 millimetres up."));
}

TEST(SceneWords, SayWhatIsTooLowToBeAnObjectInsteadOfThatThereIsNone) {
  const auto scene =
      surface_scene([](double x, double y) { return 0.01 + 0.15 * x + bump(x, y, -0.03, 0.02, 0.0002); });
  const auto parts = scene_parts(scene, 1.0, {});
  EXPECT_THAT(parts[0], HasSubstr("No object rises by 0.3 millimetres or more above the ground; lower ones "
                                  "are not counted."));
  EXPECT_EQ(parts[1], "Nothing is high and wide enough to be counted as an object.");
}

TEST(SceneWords, SayAPlaceOnceThatSeveralObjectsShare) {
  const auto scene = surface_scene([](double x, double y) {
    return bump(x, y, -0.04, 0.03, 0.008) + bump(x, y, -0.02, 0.02, 0.0081) + bump(x, y, 0.03, -0.02, 0.007);
  });
  EXPECT_THAT(scene_parts(scene, 1.0, {})[0],
              HasSubstr("3 objects rise above the ground: 2 upper left; lower right."));
}

TEST(SceneWords, SayInTheFirstPartAndBeforeTheTouchWhatCannotBeTrusted) {
  models::Scene scene = two_hills();
  scene.warnings = {"Heights are out of proportion."};
  EXPECT_THAT(scene_parts(scene, 1.0, {})[0], EndsWith("lower right. Heights are out of proportion."));
  EXPECT_THAT(opening_words(scene), HasSubstr("twin.png. Heights are out of proportion. Press D"));
}

TEST(SceneWords, GiveTheMakersDescriptionSecond) {
  models::Scene scene = two_hills();
  scene.description = "Seen from the south";
  const auto parts = scene_parts(scene, 1.0, {});
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_THAT(parts[0], Not(HasSubstr("south")));
  EXPECT_EQ(parts[1], "Seen from the south.");
}

TEST(SceneWords, NameTheObjectsAndTheGround) {
  const auto parts = scene_parts(named_hills(), 1.0, {});
  EXPECT_THAT(parts[0],
              HasSubstr("2 objects rise above the table: tall hill, upper left; low hill, lower right."));
  EXPECT_THAT(parts[1], HasSubstr("Low hill, lower right: top at 9 millimetres"));
}

TEST(SceneWords, CountANamedObjectWithSeveralPeaksOnce) {
  models::Scene scene = named_hills();
  scene.model = two_hills().model;
  // Both hills are one object now.
  scene.materials[2].name = "tall hill";
  for (auto& label : scene.labels.values())
    if (label == 2) label = 1;
  EXPECT_THAT(scene_parts(scene, 1.0, {})[0],
              HasSubstr("1 object rises above the table: tall hill, upper left."));
}

TEST(SceneWords, ListAtMostEightObjects) {
  const auto scene = surface_scene([](double x, double y) {
    double z = 0.0;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) z += bump(x, y, -0.036 + 0.024 * i, -0.024 + 0.024 * j, 0.008 + 0.0001 * i);
    return z;
  });
  const std::string brief = scene_parts(scene, 1.0, {})[0];
  EXPECT_THAT(brief, HasSubstr("12 objects rise above the ground; the most prominent: "));
  // "2 centre" stands for two of them.
  const std::size_t begin = brief.find("prominent: ");
  ASSERT_NE(begin, brief.npos);
  std::size_t listed = 0;
  for (std::size_t at = begin + 9; at != brief.npos; at = brief.find("; ", at + 2))
    listed += std::isdigit(brief.at(at + 2)) != 0 ? static_cast<std::size_t>(brief[at + 2] - '0') : 1;
  EXPECT_EQ(listed, 8U) << brief;
}

TEST(SceneWords, ApplyTheDepthAndInvertEngravedScenes) {
  EXPECT_THAT(scene_parts(two_hills(), 2.0, {})[0], HasSubstr("heights from 2 to 26 millimetres"));
  const auto engraved = scene_parts(two_hills(), -1.0, {});
  EXPECT_THAT(engraved[0], HasSubstr("heights from minus 13 millimetres to minus 1 millimetre"));
  EXPECT_THAT(engraved[0], HasSubstr("1 object rises"));
}

TEST(SceneWords, SayThatALevelSceneIsLevel) {
  const auto parts = scene_parts(surface_scene([](double, double) { return 0.002; }), 1.0, {});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_THAT(parts[0], EndsWith("level at 2 millimetres."));
  EXPECT_THAT(scene_part(two_hills(), 0.0, {}, 7), EndsWith("level at 0 millimetres."));
}

TEST(SceneWords, DescribeContoursAsLines) {
  const auto parts = scene_parts(circle_and_line(), 1.0, {});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_THAT(parts[0], StartsWith("Circle and line. 100 by 100 millimetres. 2 "
                                   "lines, 1 of them closed. The longest: closed, 126"));
  EXPECT_THAT(parts[0], HasSubstr("upper left"));
  EXPECT_THAT(parts[1],
              HasSubstr("2: open, 59 millimetres long, lower middle, straight, from left to right."));
  EXPECT_THAT(parts[0], Not(HasSubstr("height")));
}

TEST(SceneWords, CycleThroughTheParts) {
  const auto scene = two_hills();
  const auto parts = scene_parts(scene, 1.0, {});
  EXPECT_EQ(scene_part(scene, 1.0, {}, 0), parts[0] + " D again says more.");
  EXPECT_EQ(scene_part(scene, 1.0, {}, 1), parts[1] + " D again says more.");
  EXPECT_EQ(scene_part(scene, 1.0, {}, 2), parts[2] + " That is all.");
}

TEST(SceneWords, OfferNoMoreAfterTheLastPart) {
  const auto contours = circle_and_line();
  const auto parts = scene_parts(contours, 1.0, {});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(scene_part(contours, 1.0, {}, 2), "From the beginning: " + parts[0]);
  EXPECT_EQ(scene_part(contours, 1.0, {}, 3), parts[1]);
  const auto level = surface_scene([](double, double) { return 0.002; });
  EXPECT_EQ(scene_part(level, 1.0, {}, 0), scene_parts(level, 1.0, {})[0]);
}

}  // namespace
}  // namespace palpable::describe
