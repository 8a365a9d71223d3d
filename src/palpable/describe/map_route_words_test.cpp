// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/map_route_words.hpp"

#include "palpable/describe/commentary.hpp"
#include "palpable/describe/test_maps.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The probe at a pixel of the town: 0.5 m and 0.1 mm each.
Place at_pixel(const MapGuide& guide, double x, double y) { return guide.place_of({x, y}); }

TEST(MapPosition, SaysOnWhichStreetAndBetweenWhat) {
  const MapGuide guide(map_scene(town_map()));
  EXPECT_EQ(map_position_words(guide, at_pixel(guide, 600, 505)),
            "On High Street, between Mill Lane 50 metres to the west and Church Road 75 metres to the east.");
  EXPECT_EQ(map_position_words(guide, at_pixel(guide, 505, 505)),
            "At a junction: Mill Lane north, High Street east and west.");
  EXPECT_EQ(map_position_words(guide, at_pixel(guide, 200, 600)),
            "The nearest street is High Street, 50 metres to the north.");
}

TEST(MapPosition, SaysWhatIsAround) {
  const MapGuide guide(map_scene(town_map()));
  EXPECT_EQ(
      around_words(guide, at_pixel(guide, 600, 500)),
      "Around: Mill Lane 50 metres to the west; Church Road 75 metres to the east; Town Hall 100 metres to "
      "the north.");
}

TEST(MapPlaces, AreFoundByNameBeginningAndNearlyRightSpelling) {
  const MapGuide guide(map_scene(town_map()));
  for (const char* name : {"Church Road", "church road", "Chur", "Chruch Road"}) {
    const auto found = find_on_map(guide, name);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(guide.map().streets[found->piece].name, "Church Road") << name;
  }
  const auto corner = find_on_map(guide, "mill lane & high street");
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->at.x, 500.0, 1e-9);
  EXPECT_NEAR(corner->at.y, 500.0, 1e-9);
  EXPECT_THAT(find_on_map(guide, "Nowhere").error().message,
              HasSubstr("its longest streets are High Street"));
  EXPECT_THAT(find_on_map(guide, "Mill Lane & Church Road").error().message, HasSubstr("do not meet"));
}

TEST(MapRoute, IsSpokenLegByLeg) {
  const MapGuide guide(map_scene(town_map()));
  const auto ends = route_ends(guide, "Mill Lane to Church Road");
  ASSERT_TRUE(ends);
  const auto route = guide.network().route(ends->from, ends->to);
  ASSERT_TRUE(route);
  // Mill Lane's middle is 100 m north of High Street, Church Road's 25 m north of it.
  EXPECT_THAT(route_words(guide, *route),
              ElementsAre("Mill Lane, go south for 100 metres.",
                          "Turn left into High Street, go east for 130 metres.",
                          "Turn left into Church Road, go north for 25 metres.", "There is the end."));
  EXPECT_EQ(route_ends(guide, "Mill Lane").error().code, ErrorCode::usage);
}

TEST(MapPlaces, SayWhichNamesABeginningOrASpellingCouldBe) {
  StreetMap map = town_map();
  map.streets.push_back({"Church Lane", 12.0, {{750, 900}, {500, 900}}});
  const MapGuide guide(map_scene(map));
  EXPECT_EQ(find_on_map(guide, "chur").error().message, "'chur' could be Church Road and Church Lane");
  EXPECT_EQ(find_on_map(guide, "Mall Inne").error().message,
            "nothing on the map is called 'Mall Inne'; similar names are Mill Lane");
  EXPECT_EQ(find_on_map(guide, "High Street & high street").error().code, ErrorCode::usage);
  EXPECT_THAT(find_on_map(guide, "High Street & high street").error().message, HasSubstr("two streets"));
}

TEST(MapPlaces, TryWholeNamesBeforeTheirSigns) {
  StreetMap map = town_map();
  map.streets.push_back({"Road to Hell", 12.0, {{0, 800}, {400, 800}, {500, 500}}});
  map.streets.push_back({"High Street & Mill Lane", 12.0, {{0, 900}, {0, 800}}});
  const MapGuide guide(map_scene(map));
  const auto on = find_on_map(guide, "high street & mill lane");
  ASSERT_TRUE(on);
  EXPECT_NEAR(on->at.y, 850.0, 1e-9);
  const auto ends = route_ends(guide, "Road to Hell TO Mill Lane");
  ASSERT_TRUE(ends) << ends.error().message;
  EXPECT_EQ(guide.map().streets[ends->from.piece].name, "Road to Hell");
  EXPECT_EQ(guide.map().streets[ends->to.piece].name, "Mill Lane");
  EXPECT_EQ(route_ends(guide, "Mill Lane to mill").error().message, "start and end are the same");
}

TEST(MapPlaces, SayThatAStreetIsThereButCannotBeFelt) {
  StreetMap map = town_map();
  map.streets[3].felt = false;
  const MapGuide guide(map_scene(map), MapStreets::felt);
  EXPECT_EQ(find_on_map(guide, "mill").error().message,
            "Mill Lane is on the map, but cannot be felt: a smaller part of the map, or a larger size, shows "
            "it");
}

TEST(MapRoute, SaysThatTheShortestWayCannotBeFelt) {
  // From (0, 0) to (100, 0) directly, or around by (0, 200) and (100, 200).
  StreetMap map;
  map.width_px = map.height_px = 300;
  map.metres_per_px = 1.0;
  map.streets = {{"First", 6.0, {{10, 0}, {10, 200}}},
                 {"Second", 6.0, {{10, 200}, {110, 200}}},
                 {"Third", 6.0, {{110, 200}, {110, 0}}},
                 {"Direct", 6.0, {{10, 0}, {110, 0}}, false}};
  const models::Scene scene = map_scene(map);
  const MapGuide felt(scene, MapStreets::felt), all(scene);
  const auto words = [&](MapPoint a, MapPoint b) {
    const RouteEnds ends{*felt.network().nearest(a, 1.0), *felt.network().nearest(b, 1.0)};
    return detour_words(all, *felt.network().route(ends.from, ends.to), ends);
  };
  EXPECT_EQ(words({10, 0}, {110, 0}),
            "The shortest way, 100 metres, leads over streets that cannot be felt.");
  // 300 by the felt streets, 300 by the other one.
  EXPECT_EQ(words({10, 100}, {110, 100}), "");
}

TEST(MapRoute, SaysTheDirectionThatATurnIsCountedFrom) {
  // South, then bent to the west; from there to the south-west is a turn to the left.
  StreetMap map;
  map.width_px = map.height_px = 500;
  map.metres_per_px = 1.0;
  map.streets = {{"Bent Road", 6.0, {{400, 0}, {400, 200}, {202, 200}}},
                 {"Bent Road", 6.0, {{202, 200}, {197, 200}}},
                 {"Slope", 6.0, {{197, 200}, {97, 300}}}};
  const MapGuide guide(map_scene(map));
  const auto route = guide.network().route(*guide.network().nearest({400, 0}, 1.0),
                                           *guide.network().nearest({97, 300}, 1.0));
  ASSERT_TRUE(route);
  EXPECT_THAT(route_words(guide, *route),
              ElementsAre("Bent Road, go south, in the end west, for 400 metres.",
                          "Turn left into Slope, go south-west for 140 metres.", "There is the end."));
}

/// A scene whose left half is one street, and whose right half another one.
models::Scene two_streets() {
  models::Scene scene = map_scene(town_map());
  scene.labels = Raster<std::uint8_t>(100, 100, 1);
  for (int y = 0; y < 100; ++y)
    for (int x = 50; x < 100; ++x) scene.labels(x, y) = 2;
  scene.materials.resize(3);
  scene.materials[0].name = "land";
  scene.materials[1].name = "High Street";
  scene.materials[2].name = "Mill Lane";
  return scene;
}

TEST(MapCommentary, NamesAStreetOnceWithinATenthOfASecondAndNotAtEachTremor) {
  const models::Scene scene = two_streets();
  Commentary commentary(commentary_options(scene));
  std::vector<std::string> said;
  double first_s = 0.0;
  commentary.heard(scene, {-0.03, 0.0}, 0.0);
  // Two seconds of a tremor of 8 Hz across the border, after one second.
  for (int k = 0; k < 180; ++k) {
    const double t = k / 60.0, x = t < 1.0 ? -0.02 : 0.001 * std::sin(2.0 * 3.14159265 * 8.0 * t) + 0.0008;
    if (const auto words = commentary.at(scene, 1.0, {x, 0.0}, t)) {
      if (said.empty()) first_s = t;
      said.push_back(*words);
    }
  }
  EXPECT_THAT(said, ElementsAre("Mill Lane"));
  EXPECT_LE(first_s, 1.11);
}

}  // namespace
}  // namespace palpable::describe
