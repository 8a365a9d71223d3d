// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/street_colours.hpp"

#include "palpable/vision/streets/drawn_map.hpp"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr Rgb8 kGround{242, 239, 233}, kRoad{255, 255, 255}, kBuilding{217, 208, 201}, kWater{170, 211, 223},
    kPark{200, 230, 180};

/// Two crossing streets between buildings, a river and a park.
Raster<Rgb8> map_with_buildings() {
  Raster<Rgb8> picture = rgb8(drawn_map({{{{0, 190}, {399, 190}}, 12}, {{{190, 0}, {190, 399}}, 12}}));
  for (int y = 210; y < 300; ++y)
    for (int x = 210; x < 400; ++x) picture(x, y) = kWater;
  for (int y = 310; y < 400; ++y)
    for (int x = 0; x < 180; ++x) picture(x, y) = kPark;
  return picture;
}

/// The layer of the colour that a place of the map has.
MapLayer layer_at(const Raster<Rgb8>& picture, int x, int y) {
  const MapColours colours = find_map_colours(picture);
  return layers_of(colours)[colours.of_pixel(x, y)].layer;
}

TEST(StreetColours, TellStreetsBuildingsWaterAndParksApart) {
  const Raster<Rgb8> picture = map_with_buildings();
  ASSERT_TRUE((picture(22, 20) == kBuilding && picture(100, 190) == kRoad && picture(5, 5) == kGround));
  EXPECT_EQ(layer_at(picture, 100, 190), MapLayer::street);
  EXPECT_EQ(layer_at(picture, 22, 20), MapLayer::building);
  EXPECT_EQ(layer_at(picture, 300, 250), MapLayer::water);
  EXPECT_EQ(layer_at(picture, 60, 350), MapLayer::green);
  EXPECT_EQ(layer_at(picture, 5, 5), MapLayer::land);
}

TEST(StreetColours, LinesOfStreetsRunInTheirMiddleWithTheirWidth) {
  const MapColours colours = find_map_colours(map_with_buildings());
  const auto layers = layers_of(colours);
  const CentreLines& lines = layers[colours.of_pixel(100, 190)].lines;
  double length = 0.0;
  for (const CentreLine& line : lines.lines) {
    length += length_px(line.points);
    // To the middle of the first pixel that is not drawn as a street, before or behind its casing of one
    // pixel.
    EXPECT_GE(line.radius_px, 6.0);
    EXPECT_LE(line.radius_px, 7.5);
    for (const MapPoint p : line.points)
      EXPECT_LT(std::min(std::abs(p.x - 190.0), std::abs(p.y - 190.0)), 2.0) << p.x << ' ' << p.y;
  }
  // Two of 399 px, less half of the width at each end.
  EXPECT_NEAR(length, 2.0 * 399.0, 4.0 * 8.0);
}

TEST(StreetColours, SquaresOfOneColourAreNoStreets) {
  Raster<Rgb8> picture(400, 400, kGround);
  for (int k = 0; k < 9; ++k)
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 60; ++x) picture(40 + 120 * (k % 3) + x, 40 + 120 * (k / 3) + y) = kRoad;
  EXPECT_EQ(layer_at(picture, 60, 60), MapLayer::building);
}

TEST(StreetColours, WaterAndParksAreComparedWithTheLand) {
  // On a map for the night all is blue; water is bluer.
  Raster<Rgb8> picture = rgb8(drawn_map({{{{0, 190}, {399, 190}}, 12}, {{{190, 0}, {190, 399}}, 12}},
                                        {{29, 36, 60}, {90, 95, 110}, {50, 55, 70}, {38, 45, 66}}));
  const Rgb8 land = picture(5, 5);
  for (int y = 210; y < 300; ++y)
    for (int x = 210; x < 400; ++x) picture(x, y) = {land.r, land.g, static_cast<std::uint8_t>(land.b + 40)};
  EXPECT_EQ(layer_at(picture, 5, 5), MapLayer::land);
  EXPECT_EQ(layer_at(picture, 300, 250), MapLayer::water);
  EXPECT_EQ(layer_at(picture, 100, 190), MapLayer::street);
}

/// A band in a colour between the streets' and the land's, which a square has, too; with dashed casings.
Raster<Rgb8> map_with_tunnel(Rgb8 casing) {
  constexpr Rgb8 kPale{248, 247, 244};
  Raster<Rgb8> picture = map_with_buildings();
  for (int y = 310; y < 385; ++y)
    for (int x = 250; x < 320; ++x) picture(x, y) = kPale;
  for (int y = 73; y <= 87; ++y)
    for (int x = 0; x < 180; ++x) {
      const bool is_side = y == 73 || y == 87;
      const Rgb8 side = x % 6 < 4 ? casing : kGround;
      picture(x, y) = is_side ? side : kPale;
    }
  return picture;
}

TEST(StreetColours, PalerOnesWithDashedCasingsAreTunnels) {
  EXPECT_EQ(layer_at(map_with_tunnel({190, 190, 190}), 100, 80), MapLayer::street);
  EXPECT_NE(layer_at(map_with_tunnel(kGround), 100, 80), MapLayer::street);
}

}  // namespace
}  // namespace palpable::vision
