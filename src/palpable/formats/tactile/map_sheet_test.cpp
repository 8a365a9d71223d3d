// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/map_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

/// 180 x 180 mm: a street across, one from it upwards, and a pond.
MapSheet small_sheet() {
  MapSheet sheet;
  sheet.width_m = sheet.height_m = 0.18;
  sheet.streets = {{{{{{-0.09, 0, 0}, {0.09, 0, 0}}, false}}, plain_braille("hs")},
                   {{{{{0, 0, 0}, {0, 0.09, 0}}, false}}, plain_braille("ml")}};
  sheet.waters = {{{{0.03, -0.03, 0}, {0.07, -0.03, 0}, {0.07, -0.07, 0}, {0.03, -0.07, 0}}, true}};
  return sheet;
}

struct Dot {
  double x, y;
};

std::vector<Dot> dots_of(const std::string& svg) {
  std::vector<Dot> dots;
  const std::regex circle("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), circle); it != std::sregex_iterator(); ++it)
    dots.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  return dots;
}

TEST(MapSheet, WritesKeysBesideTheirStreets) {
  const auto drawing = encode_map_sheet(small_sheet(), {});
  ASSERT_TRUE(drawing);
  EXPECT_TRUE(drawing->without_room.empty());
  // h: dots 125, s: 234, m: 134, l: 123.
  const auto dots = dots_of(drawing->text);
  ASSERT_EQ(dots.size(), 12U);
  // 3 mm from the edge of the line, which is 2 mm wide, to the edge of the nearest dot.
  double nearest = 1e9;
  for (std::size_t k = 0; k < 6; ++k) nearest = std::min(nearest, std::abs(dots[k].y - 90.0) - 0.8);
  EXPECT_NEAR(nearest, 4.0, 0.6);
  for (const Dot& dot : dots) {
    EXPECT_GE(std::abs(dot.y - 90.0) - 0.8, 3.9);
    if (dot.y < 90.0) {
      EXPECT_GE(std::abs(dot.x - 90.0) - 0.8, 3.9);
    }
  }
}

TEST(MapSheet, LeavesKeysOutWhereThereIsNoRoom) {
  MapSheet sheet = small_sheet();
  sheet.streets.clear();
  // Lines every 8 mm: a key is 6.6 mm high and needs 3 mm above and below.
  for (int k = -10; k <= 10; ++k)
    sheet.streets.push_back({{{{{-0.09, 0.008 * k, 0}, {0.09, 0.008 * k, 0}}, false}}, plain_braille("ab")});
  const auto drawing = encode_map_sheet(sheet, {});
  ASSERT_TRUE(drawing);
  // Above the first and below the last one there is room.
  EXPECT_GE(drawing->without_room.size(), 19U);
}

TEST(MapSheet, StrokesOfWaterKeepAwayFromStreets) {
  MapSheet sheet = small_sheet();
  sheet.waters[0].points = {{-0.02, 0.02, 0}, {0.02, 0.02, 0}, {0.02, 0.06, 0}, {-0.02, 0.06, 0}};
  const auto drawing = encode_map_sheet(sheet, {});
  ASSERT_TRUE(drawing);
  const std::regex stroke("<path d=\"M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)\"/>");
  int strokes = 0;
  for (auto it = std::sregex_iterator(drawing->text.begin(), drawing->text.end(), stroke);
       it != std::sregex_iterator(); ++it) {
    if (std::stod((*it)[2]) < 29.0 || std::stod((*it)[2]) > 71.0 || (*it)[2] != (*it)[4]) continue;
    ++strokes;
    const double left = std::stod((*it)[1]), right = std::stod((*it)[3]);
    EXPECT_TRUE(right <= 90.0 - 4.0 + 1e-6 || left >= 90.0 + 4.0 - 1e-6) << left << " " << right;
  }
  EXPECT_GT(strokes, 8);
}

TEST(MapSheet, TheKeyIsOnPagesOfA4) {
  const std::vector<BrailleLine> lines(40, plain_braille("hs High Street"));
  const auto pages = encode_key_sheets(lines, {});
  ASSERT_EQ(pages.size(), 2U);
  EXPECT_NE(pages[0].find("width=\"210.000mm\" height=\"297.000mm\""), std::string::npos);
  for (const Dot& dot : dots_of(pages[0])) {
    EXPECT_TRUE(dot.x > 14.0 && dot.x < 196.0);
    EXPECT_TRUE(dot.y > 14.0 && dot.y < 283.0);
  }
}

TEST(MapSheet, AsBrailleHasADrawingAndThenItsKey) {
  const auto drawing =
      encode_map_braille(small_sheet(), {plain_braille("hs High Street"), plain_braille("ml Mill Lane")}, {});
  ASSERT_TRUE(drawing);
  EXPECT_TRUE(drawing->without_room.empty());
  const std::size_t page = drawing->text.find('\f');
  ASSERT_NE(page, std::string::npos);
  EXPECT_NE(drawing->text.substr(0, page).find(" HS "), std::string::npos);
  EXPECT_NE(drawing->text.substr(0, page).find(" ML"), std::string::npos);
  EXPECT_EQ(drawing->text.find("HS ,HIGH ,STREET\r\nML ,MILL ,LANE\r\n"), page + 1);
}

TEST(MapSheet, RefusesSizesThatNobodyCouldFeel) {
  MapSheetOptions options;
  options.width_m = 0.01;
  EXPECT_FALSE(encode_map_sheet(small_sheet(), options));
  options = {};
  options.dot_m = 0.0;
  EXPECT_FALSE(encode_map_sheet(small_sheet(), options));
}

}  // namespace
}  // namespace palpable::formats
