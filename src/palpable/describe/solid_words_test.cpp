// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/solid_words.hpp"

#include "palpable/describe/solid_shape.hpp"
#include "palpable/describe/test_scenes.hpp"

#include <gmock/gmock.h>

namespace palpable::describe {
namespace {

using ::testing::HasSubstr;

bool in_box(double x, double y, double at_x, double at_y, double half_x, double half_y) {
  return std::abs(x - at_x) <= half_x && std::abs(y - at_y) <= half_y;
}

/// A block of 80 x 60 mm, 20 mm high, with a tower of 30 mm at the upper left, a hole of 10 x 10 mm at the
/// upper right and a hollow of 12 x 8 mm, 6 mm deep, at the lower middle.
models::Scene block() {
  return surface_scene([](double x, double y) {
    if (!in_box(x, y, 0.0, 0.0, 0.04, 0.03) || in_box(x, y, 0.025, 0.02, 0.005, 0.005)) return 0.0;
    if (in_box(x, y, -0.025, 0.02, 0.005, 0.005)) return 0.030;
    return in_box(x, y, 0.0, -0.018, 0.006, 0.004) ? 0.014 : 0.020;
  });
}

constexpr Vec3 kBlock_m{0.08, 0.06, 0.03};

std::vector<std::string> parts_of(const models::Scene& scene, Vec3 size_m, models::SolidPose pose,
                                  const std::string& heading, Place probe = {}) {
  return solid_parts({models::relief_of(scene).get(), 0.0, size_m, pose}, heading, probe);
}

TEST(SolidWords, GiveSizeOutlineOpeningsAndTheHighestPoint) {
  const auto parts = parts_of(block(), kBlock_m, models::SolidPose::flat, "Block.");
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0],
            "Block. A solid, 80 millimetres wide, 60 millimetres deep and 30 millimetres high. Seen from "
            "above: outline rectangular; 1 hole through it and 1 hollow. Highest place: upper left, 30 "
            "millimetres above its base.");
}

TEST(SolidWords, ListEachPartAndOpening) {
  const auto parts = parts_of(block(), kBlock_m, models::SolidPose::flat, "Block.", {0.005, 0.0});
  EXPECT_THAT(parts[1], HasSubstr(" Upper left: top 30 millimetres above its base, "));
  EXPECT_THAT(parts[1],
              HasSubstr("Hollow 6 millimetres deep, lower middle, 12 by 8 millimetres, 18 millimetres "
                        "down from the middle."));
  EXPECT_THAT(parts[1],
              HasSubstr("Hole through it, upper right, 10 by 10 millimetres, 25 millimetres right, 20 "
                        "millimetres up from the middle."));
}

TEST(SolidWords, CallTheExtentTowardsThePersonDepthWhereTheSolidStandsUpright) {
  const auto parts = parts_of(block(), kBlock_m, models::SolidPose::upright, "Block.");
  EXPECT_EQ(parts[0],
            "Block. A solid, 80 millimetres wide, 60 millimetres high and 30 millimetres deep. Seen from "
            "the front: outline rectangular; 1 hole through it and 1 hollow. Nearest place: upper left, 30 "
            "millimetres from its back.");
  EXPECT_THAT(parts[1], HasSubstr("From the probe to the nearest place: "));
  EXPECT_THAT(parts[1], HasSubstr(" Upper left: front 30 millimetres from its back, "));
}

TEST(SolidWords, AreRelativeToTheSolidsOwnBoxWhereverItIs) {
  // A table before the person, which stands on the origin: legs of 40 x 30 mm and 5 mm, a top of 45 mm. The
  // relief reaches as far below the origin; the table's back is at z = -25 mm.
  constexpr double kBack_m = -0.025;
  const auto table = surface_scene([](double x, double y) {
    if (in_box(x, y, 0.0, 0.0325, 0.04, 0.0025)) return 0.025;
    return in_box(std::abs(x), y, 0.035, 0.015, 0.0025, 0.015) ? 0.020 : kBack_m;
  });
  const SolidView view{models::relief_of(table).get(),
                       kBack_m,
                       {0.08, 0.035, 0.05},
                       models::SolidPose::upright,
                       {0.0, 0.0175}};
  const auto parts = solid_parts(view, "Table.", {});
  EXPECT_THAT(parts[0], HasSubstr("Nearest place: upper middle, 50 millimetres from its back."));
  EXPECT_THAT(parts[1], HasSubstr("From the probe to the nearest place: 32 millimetres up."));
  EXPECT_THAT(parts[1], HasSubstr("Upper middle: front 50 millimetres from its back, 15 millimetres up from "
                                  "the middle."));
  EXPECT_EQ(parts[2],
            "Average distances of its front from its back in millimetres, where the solid is. Upper third, "
            "left to right: 49, 50, 49. Middle third, left to right: 45, nothing, 45. Lower third, left to "
            "right: 45, nothing, 45.");
}

TEST(SolidWords, ListPartsByTheirProminence) {
  const auto scene = surface_scene([](double x, double y) {
    if (in_box(x, y, -0.03, 0.0, 0.006, 0.006)) return 0.020;
    if (in_box(x, y, 0.03, 0.0, 0.006, 0.006)) return 0.026;
    return in_box(x, y, 0.0, 0.0, 0.045, 0.02) ? 0.010 : 0.0;
  });
  const auto parts = parts_of(scene, {0.09, 0.04, 0.026}, models::SolidPose::flat, "Towers.");
  EXPECT_THAT(parts[0], HasSubstr("2 parts rise: middle right; middle left."));
  EXPECT_THAT(parts[0], HasSubstr("; no openings."));
  EXPECT_THAT(parts[1],
              HasSubstr("Middle left: top 20 millimetres above its base, 10 millimetres above what is around "
                        "it"));
}

TEST(SolidShape, RecognisesRoundAndOvalOutlines) {
  const auto disc = surface_scene([](double x, double y) { return std::hypot(x, y) < 0.03 ? 0.01 : 0.0; });
  EXPECT_EQ(solid_shape(*models::relief_of(disc), 0.0).outline, OutlineKind::round);
  const auto oval =
      surface_scene([](double x, double y) { return std::hypot(x, 2.0 * y) < 0.04 ? 0.01 : 0.0; });
  const SolidShape shape = solid_shape(*models::relief_of(oval), 0.0);
  EXPECT_EQ(shape.outline, OutlineKind::oval);
  EXPECT_GT(shape.left_right, 0.97);
  EXPECT_GT(shape.top_bottom, 0.97);
}

TEST(SolidShape, ANotchOpenToTheSideIsNotAHollow) {
  const auto channel =
      surface_scene([](double x, double y) { return std::abs(x) < 0.01 && y < 0.01 ? 0.005 : 0.02; });
  EXPECT_TRUE(solid_shape(*models::relief_of(channel), 0.0).openings.empty());
}

TEST(SolidShape, CountsPiecesAndRecognisesABoxThatFillsThePicture) {
  const auto box = surface_scene([](double, double) { return 0.02; });
  const SolidShape shape = solid_shape(*models::relief_of(box), 0.0);
  EXPECT_EQ(shape.outline, OutlineKind::rectangular);
  EXPECT_EQ(shape.pieces, 1U);
  const auto two = surface_scene([](double x, double) { return std::abs(x) > 0.01 ? 0.02 : 0.0; });
  EXPECT_EQ(solid_shape(*models::relief_of(two), 0.0).pieces, 2U);
}

}  // namespace
}  // namespace palpable::describe
