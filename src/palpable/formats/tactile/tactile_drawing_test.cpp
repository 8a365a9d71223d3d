// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/tactile_drawing.hpp"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

/// A frame of the braille page's own size, 238.5 x 245 mm.
constexpr double kWide_m = 39 * 0.006 + 0.0025, kHigh_m = 24 * 0.010 + 0.005;
Polyline frame() {
  const double x = 0.5 * kWide_m, y = 0.5 * kHigh_m;
  return {{{-x, y, 0}, {x, y, 0}, {x, -y, 0}, {-x, -y, 0}}, true};
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

TEST(SwellPaper, HasTheDrawingsSizeAndClosedLines) {
  const std::vector<Polyline> lines{{{{-0.05, 0.025, 0}, {0.05, -0.025, 0}}, false}, frame()};
  const auto svg = encode_swell_paper(lines, 0.1, 0.05, {});
  ASSERT_TRUE(svg);
  EXPECT_NE(svg->find("width=\"100.000mm\" height=\"50.000mm\""), std::string::npos);
  EXPECT_NE(svg->find("M0.000 0.000L100.000 50.000\""), std::string::npos);
  EXPECT_EQ(std::count(svg->begin(), svg->end(), 'Z'), 1);
  const auto large = encode_swell_paper(lines, 0.1, 0.05, {0.001, 0.2});
  ASSERT_TRUE(large);
  EXPECT_NE(large->find("L200.000 100.000\""), std::string::npos);
  EXPECT_FALSE(encode_swell_paper(lines, 0.1, 0.05, {0.1, 0.2}));
}

}  // namespace
}  // namespace palpable::formats
