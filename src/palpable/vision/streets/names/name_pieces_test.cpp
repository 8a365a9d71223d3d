// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/name_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Lettering of 10 pixels height from a point on, in a direction.
TextLine straight_line(MapPoint from, double angle_deg, int length_px) {
  TextLine line;
  line.height_px = 10.0;
  line.letters = length_px / 6;
  const double angle = angle_deg * std::numbers::pi / 180.0;
  for (int i = 0; i <= length_px; ++i)
    line.centre.push_back({from.x + i * std::cos(angle), from.y + i * std::sin(angle)});
  return line;
}

TEST(NamePieces, AreWordsThatOnlyBeginOrEndAName) {
  for (const char* words : {"Rue", "Avenue de la", "Les", "Im", "Street", "1er", "II", "Quai"})
    EXPECT_TRUE(is_piece_of_name(words)) << words;
  for (const char* words : {"Rue Plati", "Mill Lane", "Landstrasse", "Les Iris", "Im Feld", ""})
    EXPECT_FALSE(is_piece_of_name(words)) << words;
}

TEST(NamePieces, JoinAroundABend) {
  // "Quai" runs down, "Albert" to the lower right and is read backwards, "1er" down again.
  TextLine albert = straight_line({105, 48}, 50.0, 40);
  std::reverse(albert.centre.begin(), albert.centre.end());
  std::vector<TextLine> lines{straight_line({135, 86}, 95.0, 18), albert, straight_line({100, 10}, 85.0, 30)};
  std::vector<ReadLine> read{{"1er", 0.9, false}, {"Albert", 0.6, true}, {"Quai", 0.9, false}};
  join_name_pieces(lines, read);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].text, "Quai Albert 1er");
  EXPECT_FALSE(read[0].reversed);
  EXPECT_GT(read[0].confidence, 0.6);
  EXPECT_LT(read[0].confidence, 0.9);
  EXPECT_NEAR(lines[0].centre.front().y, 10.0, 1e-9);
  EXPECT_GT(lines[0].centre.back().y, 100.0);
}

TEST(NamePieces, LettersOfTheNextWordAreLeftOut) {
  // "Rue" runs up, and the line goes on over the first letters of "Jean Bouin", which turns to the right.
  std::vector<TextLine> lines{straight_line({100, 100}, -90.0, 36), straight_line({96, 74}, -40.0, 60)};
  std::vector<ReadLine> read{{"Rue je", 0.86, false}, {"jean Bouin", 0.96, false}};
  join_name_pieces(lines, read);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].text, "Rue jean Bouin");
  lines = {straight_line({100, 100}, -90.0, 36), straight_line({96, 14}, -40.0, 60)};
  read = {{"Rue je", 0.86, false}, {"jean Bouin", 0.96, false}};
  join_name_pieces(lines, read);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].text, "Rue je");
}

TEST(NamePieces, TwoNamesInARowAreDivided) {
  std::vector<TextLine> lines{straight_line({10, 50}, 0.0, 210)};
  std::vector<ReadLine> read{{"Forellenweg Gerberweg", 0.8, false}};
  divide_names_in_row(lines, read);
  ASSERT_EQ(lines.size(), 2U);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].text, "Forellenweg");
  EXPECT_EQ(read[1].text, "Gerberweg");
  EXPECT_NEAR(lines[0].centre.back().x, 120.0, 5.0);
  EXPECT_NEAR(lines[1].centre.front().x, 130.0, 5.0);
  EXPECT_EQ(lines[1].centre.back().x, 220.0);
  for (const char* one : {"Alter Gerberweg", "Mill Lane", "Boulevard Charles", "Im Feldweg"}) {
    lines = {straight_line({10, 50}, 0.0, 150)};
    read = {{one, 0.9, false}};
    divide_names_in_row(lines, read);
    EXPECT_EQ(read.size(), 1U) << one;
  }
}

TEST(NamePieces, LeaveWholeNamesAndDistantWordsAlone) {
  std::vector<TextLine> lines{straight_line({10, 10}, 0.0, 60),  straight_line({78, 12}, 20.0, 60),
                              straight_line({10, 60}, 0.0, 25),  straight_line({70, 60}, 0.0, 40),
                              straight_line({10, 110}, 0.0, 25), straight_line({38, 108}, -95.0, 40)};
  std::vector<ReadLine> read{{"Mill Lane", 0.9, false}, {"Plati", 0.9, false}, {"Rue", 0.9, false},
                             {"Grimaldi", 0.9, false},  {"Rue", 0.9, false},   {"Pasteur", 0.9, false}};
  join_name_pieces(lines, read);
  // A name that is whole, a gap of 35 pixels, and a turn by 95 degrees.
  EXPECT_EQ(read.size(), 6U);
}

}  // namespace
}  // namespace palpable::vision
