// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/street_relief.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// 400 x 200 pixels: a street from left to right, one that meets it from below, a building and water.
StreetMap small_map() {
  StreetMap map;
  map.width_px = 400;
  map.height_px = 200;
  map.streets = {{"High Street", 6.0, {{0, 100}, {200, 100}}},
                 {"High Street", 6.0, {{200, 100}, {399, 100}}},
                 {"Mill Lane", 6.0, {{200, 100}, {200, 199}}}};
  map.junctions = {{{200, 100}, 3, false}};
  map.areas = {{MapArea::Kind::building, {{40, 20}, {120, 20}, {120, 97}, {40, 97}}},
               {MapArea::Kind::water, {{300, 130}, {380, 130}, {380, 180}, {300, 180}}}};
  return map;
}

std::string name_at(const StreetRelief& made, double x_px, double y_px) {
  const double scale = made.labels.width() / 400.0;
  return made.materials[made.labels(static_cast<int>(x_px * scale), static_cast<int>(y_px * scale))].name;
}

double height_at(const StreetRelief& made, double x_px, double y_px) {
  const double scale = made.relief.samples_m().width() / 400.0;
  return made.relief.samples_m()(static_cast<int>(x_px * scale), static_cast<int>(y_px * scale));
}

TEST(StreetRelief, LowersStreetsAndWaterAndRaisesBuildings) {
  const StreetReliefOptions options;
  const auto made = relief_from_street_map(small_map(), options);
  ASSERT_TRUE(made);
  EXPECT_NEAR(made->relief.size_x_m(), 0.1, 1e-3);
  EXPECT_NEAR(made->relief.size_y_m(), 0.05, 1e-3);
  const double land = options.street_depth_m;
  EXPECT_NEAR(height_at(*made, 100, 100), 0.0, 5e-5);
  EXPECT_NEAR(height_at(*made, 260, 60), land, 1e-6);
  EXPECT_NEAR(height_at(*made, 80, 50), land + options.building_m, 1e-6);
  EXPECT_NEAR(height_at(*made, 340, 155), land - options.water_depth_m, 1e-6);
}

TEST(StreetRelief, MakesStreetsAsWideAsAFingerNeedsThem) {
  StreetReliefOptions options;
  const auto made = relief_from_street_map(small_map(), options);
  ASSERT_TRUE(made);
  int low = 0;
  const auto& heights = made->relief.samples_m();
  const int column = static_cast<int>(heights.width() * 0.75);
  for (int y = 0; y < heights.height() * 6 / 10; ++y)
    low += heights(column, y) < options.street_depth_m - 1e-6 ? 1 : 0;
  // 6 px would be 1.5 mm; the narrowest street is 3 mm.
  EXPECT_NEAR(low * made->relief.pixel_m(), options.narrowest_street_m, 4e-4);
}

TEST(StreetRelief, KeepsBuildingsAwayFromStreets) {
  const StreetReliefOptions options;
  const auto made = relief_from_street_map(small_map(), options);
  ASSERT_TRUE(made);
  // The building reaches to 3 px above the street's centre line, so inside the groove.
  const double edge_px = 100 - 0.5 * options.narrowest_street_m / 0.1 * 400;
  const double gap_px = options.building_gap_m / 0.1 * 400;
  EXPECT_NEAR(height_at(*made, 80, edge_px - 0.5 * gap_px), options.street_depth_m, 1e-6);
  EXPECT_GT(height_at(*made, 80, edge_px - 2.0 * gap_px), options.street_depth_m + 1e-4);
}

TEST(StreetRelief, NamesStreetsAndTheStreetsThatMeet) {
  const auto made = relief_from_street_map(small_map(), {});
  ASSERT_TRUE(made);
  EXPECT_EQ(name_at(*made, 100, 100), "High Street");
  EXPECT_EQ(name_at(*made, 200, 150), "Mill Lane");
  EXPECT_EQ(name_at(*made, 200, 100), "junction of High Street and Mill Lane");
  EXPECT_EQ(name_at(*made, 80, 50), "building");
  EXPECT_EQ(name_at(*made, 340, 155), "water");
}

TEST(StreetRelief, NamesStreetsUpToTheNumberOfMaterials) {
  // 400 streets of 12 mm, 20 mm apart.
  StreetMap map;
  map.width_px = map.height_px = 400;
  for (int i = 0; i < 400; ++i) {
    const double x = 4.0 + 20.0 * (i % 20), y = 10.0 + 20.0 * std::floor(i / 20.0);
    map.streets.push_back({"Street " + std::to_string(i), 3.0, {{x, y}, {x + 12.0, y}}});
  }
  StreetReliefOptions options;
  options.width_m = options.height_m = 0.4;
  const auto made = relief_from_street_map(map, options);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->materials.size(), 256U);
  // Five materials have other names.
  EXPECT_EQ(made->left_out_names, 400U - 251U);
  const auto largest = std::max_element(made->labels.values().begin(), made->labels.values().end());
  EXPECT_LT(*largest, made->materials.size());
}

TEST(StreetRelief, RefusesMapsWithoutStreetsAndSizesThatNoHandCouldFollow) {
  EXPECT_FALSE(relief_from_street_map(StreetMap{}, {}));
  StreetReliefOptions options;
  options.street_depth_m = 0.0;
  EXPECT_FALSE(relief_from_street_map(small_map(), options));
  options = {};
  options.narrowest_street_m = 0.01;
  EXPECT_FALSE(relief_from_street_map(small_map(), options));
}

// The shapes of a map have the size of a finger, so the samples of a plate of 1 mm were a micrometre apart
// and took 1.5 GB.
TEST(StreetRelief, RefusesAPlateWithoutRoomForStreetsAndSamplesASmallOneNoFinerThanIsFelt) {
  StreetReliefOptions options;
  options.width_m = options.height_m = 0.001;
  const auto refused = relief_from_street_map(small_map(), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_EQ(refused.error().message,
            "a map of 1 mm has no room for two streets beside each other, which take 9 mm");
  options.width_m = options.height_m = 0.01;
  const auto made = relief_from_street_map(small_map(), options);
  ASSERT_TRUE(made) << made.error().sentence();
  EXPECT_GE(made->relief.pixel_m(), 19.9e-6);
}

}  // namespace
}  // namespace palpable::sculpt
