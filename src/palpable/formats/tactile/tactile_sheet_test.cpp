// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/tactile_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

/// 180 x 180 mm: a street across, one from it upwards, and a pond.
TactileSheet small_sheet() {
  TactileSheet sheet;
  sheet.width_m = sheet.height_m = 0.18;
  sheet.strokes = {{{{{{-0.09, 0, 0}, {0.09, 0, 0}}, false}}, plain_braille("hs")},
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

TEST(TactileSheet, WritesKeysBesideTheirStreets) {
  const auto drawing = encode_sheet(small_sheet(), {});
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

TEST(TactileSheet, LeavesKeysOutWhereThereIsNoRoom) {
  TactileSheet sheet = small_sheet();
  sheet.strokes.clear();
  // Lines every 8 mm: a key is 6.6 mm high and needs 3 mm above and below.
  for (int k = -10; k <= 10; ++k)
    sheet.strokes.push_back({{{{{-0.09, 0.008 * k, 0}, {0.09, 0.008 * k, 0}}, false}}, plain_braille("ab")});
  const auto drawing = encode_sheet(sheet, {});
  ASSERT_TRUE(drawing);
  // Above the first and below the last one there is room.
  EXPECT_GE(drawing->without_room.size(), 19U);
}

TEST(TactileSheet, StrokesOfWaterKeepAwayFromStreets) {
  TactileSheet sheet = small_sheet();
  sheet.waters[0].points = {{-0.02, 0.02, 0}, {0.02, 0.02, 0}, {0.02, 0.06, 0}, {-0.02, 0.06, 0}};
  const auto drawing = encode_sheet(sheet, {});
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

TEST(TactileSheet, TheKeyIsOnPagesOfA4) {
  const std::vector<BrailleLine> lines(40, plain_braille("hs High Street"));
  const auto pages = encode_key_sheets(lines, {});
  ASSERT_EQ(pages.size(), 2U);
  EXPECT_NE(pages[0].find("width=\"210.000mm\" height=\"297.000mm\""), std::string::npos);
  for (const Dot& dot : dots_of(pages[0])) {
    EXPECT_TRUE(dot.x > 14.0 && dot.x < 196.0);
    EXPECT_TRUE(dot.y > 14.0 && dot.y < 283.0);
  }
}

TEST(TactileSheet, AsBrailleHasADrawingAndThenItsKey) {
  const auto drawing = encode_braille_sheet(
      small_sheet(), {plain_braille("hs High Street"), plain_braille("ml Mill Lane")}, {});
  ASSERT_TRUE(drawing);
  EXPECT_TRUE(drawing->without_room.empty());
  const std::size_t page = drawing->text.find('\f');
  ASSERT_NE(page, std::string::npos);
  EXPECT_NE(drawing->text.substr(0, page).find(" HS "), std::string::npos);
  EXPECT_NE(drawing->text.substr(0, page).find(" ML"), std::string::npos);
  EXPECT_EQ(drawing->text.find("HS ,HIGH ,STREET\r\nML ,MILL ,LANE\r\n"), page + 1);
}

/// 180 x 90 mm: a square of 50 mm with a name, and a point with a name.
TactileSheet named_sheet() {
  TactileSheet sheet{"Outlines", 0.18, 0.09, {}};
  sheet.strokes = {
      {{{{{-0.06, -0.025, 0}, {-0.01, -0.025, 0}, {-0.01, 0.025, 0}, {-0.06, 0.025, 0}}, true}}}};
  const auto is_inside = [](Vec3 p) { return p.x > -0.06 && p.x < -0.01 && std::abs(p.y) < 0.025; };
  sheet.places = {{plain_braille("sq"), {-0.035, 0, 0}, is_inside},
                  {plain_braille("pt"), {0.05, 0.01, 0}, {}, SheetPlace::Mark::disc}};
  return sheet;
}

TEST(TactileSheet, WritesKeysInTheirRegionsAndBesideTheirMarks) {
  const auto drawing = encode_sheet(named_sheet(), {});
  ASSERT_TRUE(drawing);
  EXPECT_TRUE(drawing->without_room.empty());
  EXPECT_NE(drawing->text.find("r=\"2.000\""), std::string::npos);
  EXPECT_NE(drawing->text.find("L80.000 70.000L80.000 20.000L30.000 20.000Z\""), std::string::npos);
  // The mark; s: dots 234, q: 12345 in the square; p: 1234, t: 2345 within 25 mm of the point.
  const auto dots = dots_of(drawing->text);
  ASSERT_EQ(dots.size(), 1U + 8U + 8U);
  EXPECT_NEAR(dots[0].x, 140.0, 1e-6);
  for (std::size_t k = 1; k < 9; ++k) {
    EXPECT_TRUE(dots[k].x > 34.0 && dots[k].x < 76.0) << dots[k].x;
    EXPECT_TRUE(dots[k].y > 24.0 && dots[k].y < 66.0) << dots[k].y;
  }
  for (std::size_t k = 9; k < 17; ++k) {
    const double away = std::hypot(dots[k].x - 140.0, dots[k].y - 35.0);
    EXPECT_TRUE(away > 2.0 + 0.8 + 2.9 && away < 25.0) << away;
  }
}

TEST(TactileSheet, KeysWithoutRoomAreToldByTheirNumber) {
  TactileSheet sheet = named_sheet();
  // A square too small for a key, in a drawing that has no room elsewhere.
  sheet.width_m = 0.01, sheet.height_m = 0.01;
  sheet.strokes.clear();
  SheetOptions options;
  options.width_m = 0.012;
  const auto drawing = encode_sheet(sheet, options);
  ASSERT_TRUE(drawing);
  EXPECT_EQ(drawing->without_room, (std::vector<std::size_t>{0, 1}));
}

TEST(TactileSheet, HasRoomForKeysFartherFromTheirPlacesOnLargerPaper) {
  EXPECT_NEAR(key_reach_m(0.2), 0.025, 1e-9);
  EXPECT_NEAR(key_reach_m(0.322), 0.025, 1e-9);
  EXPECT_NEAR(key_reach_m(0.464), 0.036, 1e-4);
}

TEST(TactileSheet, IsAsLargeAsThePaperAllows) {
  SheetOptions options;
  options.paper = Paper::a4;
  // Twice as wide as high: across, 267 mm wide with its outermost lines, which may be 3 mm wide.
  const auto across = encode_sheet(named_sheet(), options);
  ASSERT_TRUE(across);
  EXPECT_NE(across->text.find("width=\"297.000mm\" height=\"210.000mm\""), std::string::npos);
  EXPECT_NEAR(printed_width_m(0.18, 0.09, options), 0.264, 1e-9);
  // The square begins at a sixth of the width of 264 mm, after the margin of 15 mm and half a line.
  EXPECT_NE(across->text.find("M60.500 "), std::string::npos);
  TactileSheet high = named_sheet();
  std::swap(high.width_m, high.height_m);
  options.paper = Paper::a3;
  const auto upright = encode_sheet(high, options);
  EXPECT_NE(upright->text.find("width=\"297.000mm\" height=\"420.000mm\""), std::string::npos);
  EXPECT_NEAR(printed_width_m(0.09, 0.18, options), 0.1935, 1e-9);
}

TEST(TactileSheet, AsBrailleHasTheKeysOfPlacesToo) {
  const auto drawing = encode_braille_sheet(named_sheet(), {plain_braille("sq Square")}, {});
  ASSERT_TRUE(drawing);
  EXPECT_TRUE(drawing->without_room.empty());
  EXPECT_NE(drawing->text.find("SQ"), std::string::npos);
  EXPECT_NE(drawing->text.find("PT"), std::string::npos);
}

TEST(TactileSheet, RefusesSizesThatNobodyCouldFeel) {
  SheetOptions options;
  options.width_m = 0.009;
  EXPECT_FALSE(encode_sheet(small_sheet(), options));
  options = {};
  options.dot_m = 0.0;
  EXPECT_FALSE(encode_sheet(small_sheet(), options));
}

}  // namespace
}  // namespace palpable::formats
