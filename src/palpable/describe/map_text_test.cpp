// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/map_text.hpp"

#include "palpable/describe/map_words.hpp"
#include "palpable/describe/test_maps.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(MapText, BeginsWithTitleAndScale) {
  const std::string text = map_text(map_scene(town_map()));
  EXPECT_EQ(text.substr(0, text.find('\n')), "Street map: A small town.");
  EXPECT_THAT(text, HasSubstr("It shows 500 by 500 metres; north is up. On the model of 100 by 100 "
                              "millimetres, one centimetre is 50 metres.\n"));
  EXPECT_THAT(text, HasSubstr("3 streets with names, 1 piece of a street without one, 2 junctions.\n"));
}

TEST(MapText, DescribesStreetsInTheOrderInWhichTheyMeet) {
  const std::string text = map_text(map_scene(town_map()));
  EXPECT_THAT(text, HasSubstr("Key hs: High Street, 500 metres. 500 metres from the map's edge, middle left, "
                              "east, to the map's edge, middle right. On the way: after 250 metres Mill Lane "
                              "on the left; after 380 metres Church Road across.\n"));
  EXPECT_THAT(text, HasSubstr("Key ml: Mill Lane, 200 metres. 200 metres from a street without a name, upper "
                              "middle, south, to High Street, centre.\n"));
  EXPECT_LT(text.find("\nKey hs"), text.find("\nKey ml"));
}

TEST(MapText, ListsStreetsThatCannotBeFeltLast) {
  StreetMap map = town_map();
  for (MapStreet& street : map.streets) street.felt = street.name != "High Street";
  const std::string text = map_text(map_scene(map));
  const auto heading = text.find("\nStreets that cannot be felt on this model: a smaller part of the map");
  ASSERT_NE(heading, std::string::npos);
  EXPECT_LT(text.find("\nKey cr: Church Road"), heading);
  EXPECT_LT(text.find("\nKey ml: Mill Lane"), heading);
  EXPECT_GT(text.find("\nKey hs: High Street"), heading);
  EXPECT_EQ(map_text(map_scene(town_map())).find("cannot be felt"), std::string::npos);
}

TEST(MapText, GivesTheBearingsAtJunctions) {
  const std::string text = map_text(map_scene(town_map()));
  EXPECT_THAT(
      text, HasSubstr("\nHigh Street and Mill Lane, centre: Mill Lane north, High Street east and west.\n"));
  EXPECT_THAT(text,
              HasSubstr("\nChurch Road and High Street, middle right: Church Road north and south, High "
                        "Street east and west.\n"));
}

TEST(MapText, ListsPlacesAndCountsAreas) {
  const std::string text = map_text(map_scene(town_map()));
  EXPECT_THAT(text, HasSubstr("\nPlaces.\nTown Hall, upper middle.\n"));
  EXPECT_THAT(text, HasSubstr("\n1 area of water: lower left.\n2 buildings.\n"));
}

TEST(MapText, OfAMapWithoutScaleTellsMillimetresAndDirectionsOnThePage) {
  StreetMap map = town_map();
  map.metres_per_px = 0.0;
  const std::string text = map_text(map_scene(map));
  EXPECT_THAT(text, HasSubstr("Its scale is not known: distances are those on the model of 100 by 100 "
                              "millimetres.\n"));
  EXPECT_THAT(text, HasSubstr("100 millimetres from the map's edge, middle left, right, to the map's edge"));
  EXPECT_THAT(text, Not(HasSubstr("east")));
}

TEST(MapText, CountsFurtherJunctions) {
  MapTextOptions options;
  options.most_junctions = 1;
  EXPECT_THAT(map_text(map_scene(town_map()), options),
              HasSubstr("\nFurther junctions: 1. A smaller part of the map has fewer.\n"));
}

TEST(MapGuide, GoesBetweenPlacesAndPixels) {
  const MapGuide guide(map_scene(town_map()));
  const MapPoint pixel{123.0, 456.0};
  const Place place = guide.place_of(pixel);
  EXPECT_NEAR(place.x_m, (123.5 / 1000.0 - 0.5) * 0.1, 1e-6);
  EXPECT_NEAR(guide.pixel_of(place).x, pixel.x, 1e-9);
  EXPECT_NEAR(guide.pixel_of(place).y, pixel.y, 1e-9);
}

}  // namespace
}  // namespace palpable::describe
