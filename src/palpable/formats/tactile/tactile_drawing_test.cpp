// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/tactile_drawing.hpp"

#include "palpable/formats/tactile/tactile_sheet.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

/// A frame of the braille page's own size, 238.5 x 245 mm.
constexpr double kWide_m = 39 * 0.006 + 0.0025, kHigh_m = 24 * 0.010 + 0.005;
Polyline frame() {
  const double x = 0.5 * kWide_m, y = 0.5 * kHigh_m;
  return {{{-x, y, 0}, {x, y, 0}, {x, -y, 0}, {-x, -y, 0}}, true};
}

/// A page of dots without keys.
Result<std::string> encode_braille(std::vector<Polyline> lines, double width_m, double height_m,
                                   const BrailleOptions& options) {
  const TactileSheet sheet{"", width_m, height_m, {{std::move(lines)}}};
  auto drawing = encode_braille_sheet(sheet, {}, options);
  if (!drawing) return drawing.error();
  return drawing->text;
}

std::vector<std::string> rows_of(const std::string& brf) {
  std::vector<std::string> rows;
  std::istringstream in(brf);
  for (std::string row; std::getline(in, row);) rows.push_back(row.substr(0, row.find('\r')));
  return rows;
}

TEST(Braille, DrawsAFrameWithTheOutermostDotsOfThePage) {
  const std::vector<Polyline> lines{frame()};
  const auto brf = encode_braille(lines, kWide_m, kHigh_m, {});
  ASSERT_TRUE(brf);
  const auto rows = rows_of(*brf);
  ASSERT_EQ(rows.size(), 26U);  // 25, and the form feed
  // Dots 1, 2, 3 and 4: the upper left corner; 1 and 4 along the top; 4, 5, 6 and 1: the upper right one.
  EXPECT_EQ(rows[0], "P" + std::string(38, 'C') + "?");
  // Dots 1, 2 and 3 on the left, 4, 5 and 6 on the right.
  EXPECT_EQ(rows[12], "L" + std::string(38, ' ') + "_");
  // Dots 3 and 6 along the bottom.
  EXPECT_EQ(rows[24].substr(1, 38), std::string(38, '-'));
  EXPECT_EQ(rows[25], "\f");
}

TEST(Braille, KeepsProportionsInMillimetres) {
  // A square stays a square on paper: 40 cells are 236.5 mm, 25 lines 245 mm.
  const Polyline square{{{-0.05, 0.05, 0}, {0.05, 0.05, 0}, {0.05, -0.05, 0}, {-0.05, -0.05, 0}}, true};
  const auto brf = encode_braille(std::vector<Polyline>{square}, 0.1, 0.1, {});
  ASSERT_TRUE(brf);
  const auto rows = rows_of(*brf);
  EXPECT_EQ(rows[0].size(), 40U);
  EXPECT_FALSE(rows[24].empty());
}

TEST(Braille, OnPaperLiesAsTheDrawingDoes) {
  const auto upright = braille_on(Paper::a4, 0.1, 0.1414), across = braille_on(Paper::a4, 0.1, 0.05);
  EXPECT_EQ(upright.columns, 31);
  EXPECT_EQ(upright.rows, 27);
  EXPECT_EQ(across.columns, 46);
  EXPECT_EQ(across.rows, 19);
  EXPECT_EQ(braille_on(Paper::a3, 0.1, 0.05).columns, 66);
  EXPECT_EQ(braille_on(Paper::a3, 0.1, 0.05).rows, 27);
  EXPECT_EQ(braille_on(Paper::a3, 0.1, 0.1414).columns, 46);
  EXPECT_EQ(braille_on(Paper::a3, 0.1, 0.1414).rows, 40);
}

TEST(Braille, StaysOnItsPage) {
  const auto brf = encode_braille(std::vector<Polyline>{frame()}, kWide_m, kHigh_m, {30, 20});
  ASSERT_TRUE(brf);
  for (const std::string& row : rows_of(*brf)) EXPECT_LE(row.size(), 30U);
  EXPECT_FALSE(encode_braille({}, 0.1, 0.1, {5, 20}));
}

TEST(Pins, AreAPlainBitmapOfTheLines) {
  // A frame of the display's own proportions raises its outermost pins and no others.
  const Polyline border{{{-0.059, 0.039, 0}, {0.059, 0.039, 0}, {0.059, -0.039, 0}, {-0.059, -0.039, 0}},
                        true};
  const auto pbm = encode_pins(std::vector<Polyline>{border}, 0.118, 0.078, {});
  ASSERT_TRUE(pbm);
  EXPECT_EQ(pbm->substr(0, 9), "P1\n60 40\n");
  EXPECT_EQ(pbm->size(), 9U + 40U * 61U);
  EXPECT_EQ(std::count(pbm->begin() + 9, pbm->end(), '1'), 2 * 60 + 2 * 38);
  EXPECT_EQ(pbm->substr(9, 60), std::string(60, '1'));
}

TEST(Pins, KeepProportionsInTheMiddle) {
  const Polyline line{{{0, 0.05, 0}, {0, -0.05, 0}}, false};
  const auto pbm =
      encode_pins(std::vector<Polyline>{line, Polyline{{{0.05, 0, 0}}, false}}, 0.1, 0.1, {5, 3});
  ASSERT_TRUE(pbm);
  EXPECT_EQ(*pbm, "P1\n5 3\n00100\n00100\n00100\n");
  EXPECT_FALSE(encode_pins({}, 0.1, 0.1, {0, 3}));
}

TEST(Pins, OfAStairHaveNoPinsAtItsInnerCorners) {
  // A diagonal: one pin in each column.
  const Polyline line{{{-0.05, -0.02, 0}, {0.05, 0.02, 0}}, false};
  const auto pbm = encode_pins(std::vector<Polyline>{line}, 0.118, 0.078, {});
  ASSERT_TRUE(pbm);
  EXPECT_EQ(std::count(pbm->begin() + 9, pbm->end(), '1'), 51);
}

TEST(Pins, OfACornerBetweenStraightLinesStayPointed) {
  const Polyline corner{{{-0.051, 0.011, 0}, {0.001, 0.011, 0}, {0.001, -0.021, 0}}, false};
  const auto pbm = encode_pins(std::vector<Polyline>{corner}, 0.118, 0.078, {});
  ASSERT_TRUE(pbm);
  // 27 columns, and 16 rows below them.
  EXPECT_EQ(std::count(pbm->begin() + 9, pbm->end(), '1'), 27 + 16);
}

TEST(Pins, OfLinesSideBySideLeaveAFreePinBetween) {
  PinOptions pins;
  std::vector<Polyline> lines;
  for (int k = 0; k < 8; ++k) {
    const double y = 0.011 - 0.002 * k;
    lines.push_back({{{-0.051, y, 0}, {0.049, y, 0}}, false});
  }
  const auto crowded = encode_pins(lines, 0.118, 0.078, pins);
  pins.spacing = LineSpacing::spaced;
  const auto spaced = encode_pins(lines, 0.118, 0.078, pins);
  ASSERT_TRUE(crowded && spaced);
  EXPECT_NE(crowded->find("\n" + std::string(4, '0') + std::string(51, '1')), std::string::npos);
  std::istringstream in(spaced->substr(9));
  bool before = false;
  int raised = 0;
  for (std::string row; std::getline(in, row);) {
    const bool has = row.find('1') != std::string::npos;
    EXPECT_FALSE(has && before);
    before = has;
    raised += has;
  }
  EXPECT_GE(raised, 3);
}

}  // namespace
}  // namespace palpable::formats
