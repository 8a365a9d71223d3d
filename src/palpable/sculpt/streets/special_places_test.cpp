// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/street_relief.hpp"

#include <string>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

// One street from west to east at y = 500 with a bus stop and two crossings, a large church north of it, a
// hospital without an outline south of it, and a house beside the church.
StreetMap village() {
  StreetMap map;
  map.width_px = map.height_px = 1000;
  map.metres_per_px = 0.3;
  map.streets = {{"Mill Lane", 20.0, {{0, 500}, {999, 500}}}};
  map.areas = {{MapArea::Kind::building, {{300, 300}, {400, 300}, {400, 400}, {300, 400}}},
               {MapArea::Kind::building, {{405, 300}, {480, 300}, {480, 400}, {405, 400}}}};
  map.places = {
      {MapPlace::Kind::church, "St Mary", {350, 350}, {{300, 300}, {400, 300}, {400, 400}, {300, 400}}},
      {MapPlace::Kind::hospital, "", {700, 700}},
      {MapPlace::Kind::bus_stop, "Mill Lane", {200, 515}},
      {MapPlace::Kind::crossing, "", {600, 500}, {}, true},
      {MapPlace::Kind::crossing, "", {615, 500}}};
  return map;
}

struct At {
  std::string name;
  double height_m;
};

At at(const StreetRelief& made, double x_px, double y_px) {
  const double scale = made.labels.width() / 1000.0;
  const int x = static_cast<int>(x_px * scale), y = static_cast<int>(y_px * scale);
  return {made.materials[made.labels(x, y)].name, made.relief.samples_m()(x, y)};
}

TEST(SpecialPlaces, BuildingsAreHigherAndHaveTheirNames) {
  const auto made = relief_from_street_map(village(), {});
  ASSERT_TRUE(made);
  const At church = at(*made, 350, 350), house = at(*made, 450, 350), hospital = at(*made, 700, 700);
  EXPECT_EQ(church.name, "St Mary, church");
  EXPECT_EQ(house.name, "building");
  EXPECT_EQ(hospital.name, "hospital");
  EXPECT_NEAR(church.height_m - house.height_m, SpecialPlaceOptions{}.rise_m, 1e-5);
  EXPECT_NEAR(hospital.height_m, church.height_m, 1e-5);
  EXPECT_TRUE(check_tactile_rules(made->relief, made->parts, {}).empty());
}

TEST(SpecialPlaces, StopsAndCrossingsAreTexturesInTheStreet) {
  const auto made = relief_from_street_map(village(), {});
  ASSERT_TRUE(made);
  EXPECT_EQ(at(*made, 200, 505).name, "Mill Lane, bus stop");
  EXPECT_EQ(at(*made, 600, 500).name, "crossing with tactile paving");
  // The plain one has no room beside it.
  EXPECT_EQ(made->felt_places, (std::vector<bool>{true, true, true, true, false}));
  EXPECT_EQ(made->materials[made->labels(614, 512)].texture.kind, models::TouchTexture::Kind::bumps);
}

TEST(SpecialPlaces, WhatIsNearASpecialBuildingGivesWay) {
  StreetMap map = village();
  // 2 mm away: too near for a finger, and larger.
  map.areas[1].outline = {{420, 200}, {700, 200}, {700, 420}, {420, 420}};
  StreetReliefOptions options;
  options.rules.least_gap_m = 0.003;
  const auto made = relief_from_street_map(map, options);
  ASSERT_TRUE(made);
  EXPECT_EQ(at(*made, 350, 350).name, "St Mary, church");
  EXPECT_TRUE(check_tactile_rules(made->relief, made->parts, {}).empty());
}

TEST(SpecialPlaces, ARoundaboutHasItsOwnGroove) {
  StreetMap map = village();
  map.places = {
      {MapPlace::Kind::roundabout, "", {500, 500}, {{485, 500}, {500, 485}, {515, 500}, {500, 515}}}};
  const auto made = relief_from_street_map(map, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(at(*made, 500, 500).name, "roundabout");
  EXPECT_EQ(at(*made, 600, 500).name, "Mill Lane");
  EXPECT_TRUE(made->felt_places[0]);
}

TEST(SpecialPlaces, StepsHaveRidges) {
  StreetMap map = village();
  map.streets.push_back({"", 10.0, {{100, 500}, {100, 900}}, true, MapStreet::Kind::steps});
  const auto made = relief_from_street_map(map, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(at(*made, 100, 700).name, "steps");
  EXPECT_EQ(made->materials[made->labels(102, 716)].texture.kind, models::TouchTexture::Kind::ridges);
}

}  // namespace
}  // namespace palpable::sculpt
