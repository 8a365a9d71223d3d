// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/map_places.hpp"

#include "palpable/describe/map_route_words.hpp"
#include "palpable/describe/map_text.hpp"
#include "palpable/describe/test_maps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The town with a church, a hospital for which there was no room, two crossings, a stop and steps; the words
/// "Town Hall" are known as a place.
StreetMap town_with_places() {
  StreetMap map = town_map();
  map.places = {
      {MapPlace::Kind::church, "St Mary", {300, 200}, {{260, 160}, {340, 160}, {340, 240}, {260, 240}}},
      {MapPlace::Kind::hospital, "", {850, 850}},
      {MapPlace::Kind::town_hall, "Town Hall", {650, 310}},
      {MapPlace::Kind::crossing, "", {600, 500}, {}, true},
      {MapPlace::Kind::crossing, "", {640, 500}},
      {MapPlace::Kind::bus_stop, "Mill Lane", {300, 505}}};
  map.places[1].felt = false;
  map.streets.push_back({"", 6.0, {{200, 500}, {200, 650}}, true, MapStreet::Kind::steps});
  return map;
}

TEST(SpecialPlaceWords, AreSaidWhereTheProbeIs) {
  const MapGuide guide(map_scene(town_with_places()));
  EXPECT_EQ(map_position_words(guide, guide.place_of({330, 170})),
            "At St Mary, church. The nearest street is Mill Lane, 85 metres to the east.");
  EXPECT_THAT(map_position_words(guide, guide.place_of({602, 500})),
              HasSubstr("At crossing with tactile paving. On High Street, between"));
  EXPECT_THAT(map_position_words(guide, guide.place_of({200, 600})), HasSubstr("On steps, between"));
}

TEST(SpecialPlaceWords, OfSeveralCrossingsTheNearestIsAround) {
  const MapGuide guide(map_scene(town_with_places()));
  const std::string around = around_words(guide, guide.place_of({620, 450}));
  EXPECT_THAT(around, HasSubstr("crossing 25 metres"));
  EXPECT_EQ(around.find("Town Hall"), around.rfind("Town Hall")) << around;
}

TEST(SpecialPlaceWords, AreListedInTheTextAndTheDescription) {
  const models::Scene scene = map_scene(town_with_places());
  const std::string text = map_text(scene);
  EXPECT_THAT(
      text, HasSubstr("\nSpecial places.\nSt Mary, church, upper left.\nHospital, lower right, which cannot "
                      "be felt.\nTown Hall, upper middle.\nMill Lane, bus stop, middle left.\n"
                      "2 crossings, 1 of them with tactile paving.\n"));
  EXPECT_THAT(text, Not(HasSubstr("\nPlaces.")));
  const auto parts = map_parts(scene, {0.0, 0.0});
  EXPECT_EQ(
      parts[2],
      "Special places: St Mary, church, upper left; hospital, lower right, which cannot be felt; Town Hall, "
      "upper middle.");
}

TEST(SpecialPlaceWords, PlacesAreFoundByNameKindAndBoth) {
  const MapGuide guide(map_scene(town_with_places()));
  for (const char* const name : {"St Mary", "st mary, church", "hospital"})
    EXPECT_TRUE(find_on_map(guide, name)) << name;
  // The street, not its bus stop.
  EXPECT_EQ(guide.map().streets[find_on_map(guide, "Mill Lane")->piece].name, "Mill Lane");
  EXPECT_NEAR(find_on_map(guide, "Mill Lane, bus stop")->at.x, 300.0, 1e-9);
  EXPECT_TRUE(find_on_map(guide, "Mill")) << "both names are one";
}

}  // namespace
}  // namespace palpable::describe
