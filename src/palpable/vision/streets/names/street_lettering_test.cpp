// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/street_lettering.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr StreetLettering kLettering{10.0, {0, 0, 0}};

/// A quarter of a circle of 100 pixels around (20, 20), as a street.
CentreLines bent_street() {
  CentreLines graph{{{120, 20}, {20, 120}}, {{{}, 0, 1, 8.0, 0.0}}};
  for (int i = 0; i <= 157; ++i)
    graph.lines[0].points.push_back({20.0 + 100.0 * std::cos(i / 100.0), 20.0 + 100.0 * std::sin(i / 100.0)});
  return graph;
}

/// White, with strokes of ink of 2 x `height` pixels across the bent street from angle `first` to `last`.
Raster<Rgb8> lettered(double first, double last, double height) {
  Raster<Rgb8> picture(140, 140, {255, 255, 255});
  for (double a = first; a <= last; a += 0.06)
    for (double r = 100.0 - 0.5 * height; r <= 100.0 + 0.5 * height; r += 0.5)
      for (const double more : {0.0, 0.01})
        picture(static_cast<int>(std::lround(20.0 + r * std::cos(a + more))),
                static_cast<int>(std::lround(20.0 + r * std::sin(a + more)))) = {0, 0, 0};
  return picture;
}

TEST(StreetLettering, ANameBendsWithItsStreet) {
  const auto found = lettering_along(lettered(0.4, 1.2, 9.0), bent_street(), kLettering, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].height_px, 10.0, 2.0);
  EXPECT_NEAR(static_cast<double>(found[0].centre.size()), 81.0, 8.0);
  for (const MapPoint p : found[0].centre) EXPECT_NEAR(std::hypot(p.x - 20.0, p.y - 20.0), 100.0, 2.0);
}

TEST(StreetLettering, LowInkAndShortInkAreNoNames) {
  EXPECT_TRUE(lettering_along(lettered(0.4, 1.2, 2.0), bent_street(), kLettering, {}).empty());
  EXPECT_TRUE(lettering_along(lettered(0.4, 0.5, 9.0), bent_street(), kLettering, {}).empty());
}

/// A level line between two columns.
TextLine level_line(int first, int last) {
  TextLine line;
  line.height_px = 10.0;
  for (int x = first; x < last; ++x) line.centre.push_back({static_cast<double>(x), 50.0});
  return line;
}

TEST(StreetLettering, TwoNamesBesideEachOtherStayInsteadOfALineWithBoth) {
  std::vector<TextLine> lines{level_line(0, 170), level_line(0, 80), level_line(90, 170)};
  std::vector<ReadLine> read{{"ForellenweS Bammiliweg", 0.8, false, {}, 3.0},
                             {"Forellenweg", 0.9, false, {}, 1.6},
                             {"Bammiliweg", 0.9, false, {}, 1.6}};
  keep_best_readings(lines, read);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].text, "Forellenweg");
}

TEST(StreetLettering, TheCapitalOfAnotherReadingStays) {
  std::vector<TextLine> lines{level_line(0, 80), level_line(2, 80)};
  std::vector<ReadLine> read{{"Pradafant", 0.8, false, {}, 1.2}, {"pradafant", 0.9, false, {}, 1.6}};
  keep_best_readings(lines, read);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].text, "Pradafant");
}

TEST(StreetLettering, OfLinesAtTheSamePlaceTheFollowedOneIsRead) {
  const auto lines = different_lines({level_line(0, 80)}, {level_line(10, 80), level_line(0, 160)});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1].centre.size(), 160U);
}

TEST(StreetLettering, MoreThatIsReadStays) {
  const TextLine whole = level_line(0, 80);
  TextLine piece = whole;
  piece.centre.erase(piece.centre.begin(), piece.centre.begin() + 30);
  std::vector<TextLine> lines{piece, whole};
  std::vector<ReadLine> read{{"Victor Hugo", 0.97, false, {}, 2.0}, {"Rue Victor Hugo", 0.9, false, {}, 1.8}};
  EXPECT_TRUE(unread_lettering({piece}, lines, read, 0.85).empty());
  keep_best_readings(lines, read);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].text, "Rue Victor Hugo");
  EXPECT_EQ(lines[0].centre.size(), 80U);
}

}  // namespace
}  // namespace palpable::vision
