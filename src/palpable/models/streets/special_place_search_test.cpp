// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/streets/special_place_search.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

/// Four arms of 200 px at a ring of four pieces with this radius.
StreetMap ring_of_streets(double radius, int points_of_piece = 8) {
  StreetMap map;
  map.width_px = map.height_px = 600;
  const auto at = [radius](double angle) {
    return MapPoint{300.0 + radius * std::cos(angle), 300.0 + radius * std::sin(angle)};
  };
  for (int k = 0; k < 4; ++k) {
    MapStreet piece{"", 10.0, {}};
    for (int i = 0; i <= points_of_piece; ++i)
      piece.points.push_back(at((k + 1.0 * i / points_of_piece) * std::numbers::pi / 2.0));
    map.streets.push_back(piece);
    const double angle = k * std::numbers::pi / 2.0;
    const MapPoint end{300.0 + 200.0 * std::cos(angle), 300.0 + 200.0 * std::sin(angle)};
    map.streets.push_back({"Arm", 10.0, {at(angle), end}});
    map.junctions.push_back({at(angle), 3, false});
  }
  return map;
}

TEST(SpecialPlaceSearch, ASmallRoundRingIsARoundabout) {
  StreetMap map = ring_of_streets(25.0);
  add_special_places(map);
  ASSERT_EQ(map.places.size(), 1U);
  EXPECT_EQ(map.places[0].kind, MapPlace::Kind::roundabout);
  EXPECT_NEAR(map.places[0].at.x, 300.0, 0.5);
  EXPECT_NEAR(map.places[0].at.y, 300.0, 0.5);
  EXPECT_TRUE(map.junctions[0].roundabout);
}

TEST(SpecialPlaceSearch, BlocksAndLargeRingsAreNone) {
  StreetMap square = ring_of_streets(25.0, 1);
  add_special_places(square);
  EXPECT_TRUE(square.places.empty());
  StreetMap large = ring_of_streets(120.0);
  add_special_places(large);
  EXPECT_TRUE(large.places.empty());
  EXPECT_FALSE(large.junctions[0].roundabout);
}

TEST(SpecialPlaceSearch, WordsNameTheBuildingAtThem) {
  StreetMap map = ring_of_streets(120.0);
  map.areas = {{MapArea::Kind::building, {{400, 400}, {460, 400}, {460, 440}, {400, 440}}},
               {MapArea::Kind::building, {{100, 100}, {140, 100}, {140, 140}, {100, 140}}}};
  map.labels = {{"St Mary's Church", 0.9, 0.0, {{390, 445}, {470, 445}, {470, 457}, {390, 457}}, false},
                {"Church Road", 0.9, 0.0, {{100, 500}, {170, 500}, {170, 512}, {100, 512}}, false}};
  add_special_places(map);
  ASSERT_EQ(map.places.size(), 1U);
  EXPECT_EQ(map.places[0].kind, MapPlace::Kind::church);
  EXPECT_EQ(map.places[0].name, "St Mary's Church");
  EXPECT_EQ(map.places[0].outline.size(), 4U);
  EXPECT_NEAR(map.places[0].at.x, 430.0, 1e-9);
}

}  // namespace
}  // namespace palpable::models
