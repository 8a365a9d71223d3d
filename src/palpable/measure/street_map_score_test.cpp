// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/street_map_score.hpp"

#include <gtest/gtest.h>

namespace palpable::measure {
namespace {

constexpr int kSide = 200;

/// A crossing at 100,100, with a path beside.
TrueStreetMap truth() {
  TrueStreetMap out{kSide, kSide, {}, {}};
  out.streets.push_back({"residential", "Rue Émile Zola", 10.0, {{{0, 100}, {100, 100}, {199, 100}}}});
  out.streets.push_back({"tertiary", "Mill Lane", 10.0, {{{100, 0}, {100, 100}, {100, 199}}}});
  out.streets.push_back({"footway", "", 3.0, {{{0, 40}, {199, 40}}}});
  return out;
}

StreetMap found_map() {
  StreetMap map;
  map.width_px = map.height_px = kSide;
  map.streets = {{"Rue Emile Zola", 10.0, {{0, 100}, {100, 100}}},
                 {"Rue Emile Zola", 10.0, {{100, 100}, {199, 100}}},
                 {"Mill Lane", 10.0, {{100, 0}, {100, 100}}},
                 {"", 10.0, {{100, 100}, {100, 199}}}};
  map.junctions = {{{101, 99}, 4, false}};
  return map;
}

TEST(StreetMapScore, IsFullForTheTruth) {
  const auto score = score_street_map(found_map(), truth());
  ASSERT_TRUE(score);
  EXPECT_EQ(score->found, 1.0);
  EXPECT_EQ(score->true_part, 1.0);
  EXPECT_EQ(score->area_iou, 1.0);
  EXPECT_EQ(score->junction_f(), 1.0);
  EXPECT_EQ(score->junctions_right_degree, 1);
  EXPECT_EQ(score->names, 2);
  EXPECT_EQ(score->names_right, 2);
  EXPECT_EQ(score->names_false, 0);
}

TEST(StreetMapScore, CountsWhatIsMissingAndWhatIsFalse) {
  StreetMap map = found_map();
  // Half of a street is lost, one name is wrong, and a line of the length of a street is nowhere.
  map.streets[3] = {"Mole Lane", 10.0, {{0, 160}, {199, 160}}};
  map.junctions = {{{100, 100}, 3, false}, {{50, 160}, 3, false}};
  const auto score = score_street_map(map, truth());
  ASSERT_TRUE(score);
  // The false line ends on the street that crosses it.
  EXPECT_NEAR(score->found, 0.75, 0.04);
  EXPECT_NEAR(score->true_part, 300.0 / 500.0, 0.02);
  // Areas: 2 x 200 x 10 are true, of which 3/4 were found; 2000 more are false.
  EXPECT_NEAR(score->area_iou, 3000.0 / 6000.0, 0.03);
  EXPECT_EQ(score->junctions_found, 1);
  EXPECT_EQ(score->junctions_right_degree, 0);
  EXPECT_EQ(score->junctions_false, 1);
  EXPECT_NEAR(score->junction_f(), 2.0 / 3.0, 1e-9);
  EXPECT_EQ(score->names_false, 1);
}

TEST(StreetMapScore, TakesPathsForTrueButDoesNotWantThem) {
  StreetMap map = found_map();
  map.streets.push_back({"", 3.0, {{0, 40}, {199, 40}}});
  map.junctions.push_back({{100, 40}, 4, false});
  const auto score = score_street_map(map, truth());
  ASSERT_TRUE(score);
  EXPECT_EQ(score->true_part, 1.0);
  EXPECT_EQ(score->area_iou, 1.0);
  // The path does not share a point with the street that it crosses.
  EXPECT_EQ(score->junctions_false, 1);
}

TEST(StreetMapScore, TellsDistancesApart) {
  StreetMap map = found_map();
  for (MapStreet& street : map.streets)
    for (MapPoint& p : street.points) p = {p.x + 2.8, p.y + 2.8};
  map.streets.resize(2);
  TrueStreetMap across = truth();
  across.streets.resize(1);
  const auto score = score_street_map(map, across);
  ASSERT_TRUE(score);
  EXPECT_GT(score->found, 0.98);
  EXPECT_LT(score->found_closely, 0.1);
  EXPECT_GT(score->true_part, 0.98);
}

TEST(StreetMapScore, PrefersTheNamesThatAreKnownToBeDrawn) {
  TrueStreetMap map = truth();
  map.drawn_names = {"Mill Lane"};
  const auto score = score_street_map(found_map(), map);
  ASSERT_TRUE(score);
  EXPECT_EQ(score->names, 1);
  EXPECT_EQ(score->names_right, 1);
}

TEST(StreetMapScore, RefusesOtherSizesAndEmptyTruths) {
  TrueStreetMap small = truth();
  small.width_px = 100;
  EXPECT_FALSE(score_street_map(found_map(), small));
  TrueStreetMap paths = truth();
  paths.streets.erase(paths.streets.begin(), paths.streets.begin() + 2);
  EXPECT_FALSE(score_street_map(found_map(), paths));
}

}  // namespace
}  // namespace palpable::measure
