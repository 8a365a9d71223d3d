// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/streets/map_view.hpp"

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

StreetMap wide_map() {
  StreetMap map;
  map.width_px = 1000;
  map.height_px = 500;
  map.metres_per_px = 2.0;
  map.streets = {{"Long Road", 10.0, {{0, 250}, {999, 250}}, false},
                 {"Far Lane", 6.0, {{900, 0}, {900, 100}}}};
  map.areas = {{MapArea::Kind::water, {{0, 0}, {1000, 0}, {1000, 200}, {0, 200}}}};
  map.places = {{MapPlace::Kind::church, "St Mary", {500, 240}}, {MapPlace::Kind::museum, "", {10, 10}}};
  map.junctions = {{{500, 250}, 3, false}, {{900, 250}, 3, false}};
  return map;
}

TEST(MapView, ThePlaceUnderTheHandStaysThere) {
  const StreetMap map = wide_map();
  MapView view;
  const MapPoint hand{600.0, 200.0};
  for (const double zoom : {2.0, 4.0, 8.0, 4.0, 2.0}) {
    view = zoomed_about(map, view, hand, zoom);
    EXPECT_NEAR(view.in_whole(hand).x, 600.0, 1e-9) << zoom;
    EXPECT_NEAR(view.in_whole(hand).y, 200.0, 1e-9) << zoom;
  }
}

TEST(MapView, NothingBeyondTheMapIsShown) {
  const StreetMap map = wide_map();
  // Zoomed at one place, then out at another one.
  MapView view = zoomed_about(map, {}, {0.0, 0.0}, 8.0);
  view = zoomed_about(map, view, {900.0, 400.0}, 1.0);
  EXPECT_EQ(view.corner.x, 0.0);
  EXPECT_EQ(view.corner.y, 0.0);
}

TEST(MapView, APartHasWhatLiesInItAtItsOwnScale) {
  const StreetMap map = wide_map();
  const StreetMap part = part_of_map(map, {{375.0, 187.5}, 4.0});
  EXPECT_EQ(part.width_px, 1000);
  EXPECT_DOUBLE_EQ(part.metres_per_px, 0.5);
  ASSERT_EQ(part.streets.size(), 1U);
  EXPECT_TRUE(part.streets[0].felt);
  EXPECT_DOUBLE_EQ(part.streets[0].width_px, 40.0);
  EXPECT_NEAR(part.streets[0].points.front().x, 0.0, 1e-9);
  EXPECT_NEAR(part.streets[0].points.back().x, 999.0, 1e-9);
  EXPECT_NEAR(part.streets[0].points.back().y, 250.0, 1e-9);
  ASSERT_EQ(part.places.size(), 1U);
  EXPECT_NEAR(part.places[0].at.x, 500.0, 1e-9);
  EXPECT_EQ(part.junctions.size(), 1U);
  ASSERT_EQ(part.areas.size(), 1U);
}

}  // namespace
}  // namespace palpable::models
