// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/colours/map_colours.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr Rgb8 kLand{242, 239, 233}, kRiver{170, 211, 223}, kStreet{255, 200, 120}, kInk{20, 20, 20};

void fill(Raster<Rgb8>& picture, int left, int top, int width, int height, Rgb8 colour) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x) picture(x, y) = colour;
}

/// Land with a river (rows 20 to 59), a street (rows 100 to 108), and letters of one-pixel strokes.
Raster<Rgb8> small_map() {
  Raster<Rgb8> picture(200, 200, kLand);
  fill(picture, 0, 20, 200, 40, kRiver);
  fill(picture, 0, 100, 200, 9, kStreet);
  for (int i = 0; i < 6; ++i) fill(picture, 40 + 6 * i, 150, 1, 10, kInk);
  return picture;
}

int difference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// The index of a colour, or -1. Values are means of bins of four levels.
int index_of(const MapColours& colours, Rgb8 value, int tolerance = 4) {
  const auto found = std::find_if(colours.colours.begin(), colours.colours.end(), [&](const MapColour& c) {
    return difference(c.value, value) <= tolerance;
  });
  return found == colours.colours.end() ? -1 : static_cast<int>(found - colours.colours.begin());
}

TEST(MapColours, AreThoseOfTheAreas) {
  const MapColours colours = find_map_colours(small_map());
  ASSERT_EQ(colours.colours.size(), 3U);
  EXPECT_EQ(index_of(colours, kInk), -1) << "strokes are no area";
  EXPECT_EQ(index_of(colours, kLand), 0) << "the most frequent one is first";
  EXPECT_EQ(colours.colours[static_cast<std::size_t>(index_of(colours, kRiver))].pixels, 200 * 40);
  EXPECT_EQ(colours.colours[static_cast<std::size_t>(index_of(colours, kStreet))].pixels, 200 * 9);
  EXPECT_EQ(colours.page, MapColours::kNone);
}

TEST(MapColours, GiveEachPixelTheAreaInWhichItLies) {
  const MapColours colours = find_map_colours(small_map());
  const int land = index_of(colours, kLand), river = index_of(colours, kRiver),
            street = index_of(colours, kStreet);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const bool in_river = y >= 20 && y < 60, on_street = y >= 100 && y < 109;
      EXPECT_EQ(colours.of_pixel(x, y), in_river ? river : on_street ? street : land) << x << ' ' << y;
    }
  // Under the letters the picture does not show it.
  EXPECT_EQ(colours.seen(40, 155), 0);
  EXPECT_EQ(colours.seen(40, 180), MapColours::kArea);
}

TEST(MapColours, OfACleanDrawingAreTwoWhereTheyDifferByLittle) {
  constexpr Rgb8 kTunnel{245, 244, 242}, kBlend{243, 241, 238};
  Raster<Rgb8> picture = small_map();
  fill(picture, 0, 120, 200, 10, kTunnel);
  fill(picture, 0, 119, 200, 1, kBlend);
  fill(picture, 0, 130, 200, 1, kBlend);
  const MapColours colours = find_map_colours(picture);
  ASSERT_EQ(colours.colours.size(), 4U) << "without the blend at the edges";
  const int tunnel = index_of(colours, kTunnel, 0);
  ASSERT_GE(tunnel, 0);
  EXPECT_EQ(colours.of_pixel(100, 125), tunnel);
  EXPECT_EQ(colours.of_pixel(100, 140), index_of(colours, kLand, 0));
}

TEST(MapColours, LongThinLinesOfAnAreasColourAreStreets) {
  Raster<Rgb8> picture = small_map();
  fill(picture, 20, 120, 60, 2, kStreet);
  fill(picture, 120, 120, 10, 2, kStreet);
  const MapColours colours = find_map_colours(picture);
  const int street = index_of(colours, kStreet);
  EXPECT_EQ(colours.of_pixel(50, 120), street);
  EXPECT_EQ(colours.seen(50, 120), MapColours::kThinLine);
  EXPECT_NE(colours.of_pixel(125, 120), street) << "as long as a letter";
}

TEST(MapColours, AreFoundInANoisyScan) {
  Raster<Rgb8> picture = small_map();
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 3.0);
  const auto noisy = [&](std::uint8_t v) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(v + noise(random)), 0L, 255L));
  };
  for (Rgb8& c : picture.values()) c = {noisy(c.r), noisy(c.g), noisy(c.b)};
  const MapColours colours = find_map_colours(picture);
  const int land = index_of(colours, kLand), river = index_of(colours, kRiver),
            street = index_of(colours, kStreet);
  ASSERT_GE(land, 0);
  ASSERT_GE(river, 0);
  ASSERT_GE(street, 0);
  int wrong = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const bool in_river = y >= 20 && y < 60, on_street = y >= 100 && y < 109;
      wrong += colours.of_pixel(x, y) != (in_river ? river : on_street ? street : land) ? 1 : 0;
    }
  EXPECT_LT(wrong, 200 * 200 / 100);
}

TEST(MapColours, ThePageAroundAMapIsAColourOfItsOwn) {
  constexpr Rgb8 kPage{250, 250, 250};
  Raster<Rgb8> picture(300, 280, kPage);
  const Raster<Rgb8> map = small_map();
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) picture(x + 50, y + 40) = map(x, y);
  const MapColours colours = find_map_colours(picture);
  ASSERT_NE(colours.page, MapColours::kNone);
  EXPECT_EQ(colours.of_pixel(10, 10), colours.page);
  EXPECT_EQ(colours.of_pixel(150, 120), index_of(colours, kLand));
  EXPECT_EQ(colours.colours[colours.page].pixels, 0);
}

TEST(MapColours, APictureOfNoiseHasNone) {
  Raster<Rgb8> picture(128, 128);
  std::mt19937 random(11);
  const auto level = [&random] { return static_cast<std::uint8_t>(random() & 0xFFU); };
  for (Rgb8& c : picture.values()) c = {level(), level(), level()};
  EXPECT_TRUE(find_map_colours(picture).colours.empty());
}

}  // namespace
}  // namespace palpable::vision
