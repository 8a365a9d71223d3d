// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/printed_marker.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

// A row of a code has three cells of parity and two of data, the second and the fourth (Garrido-Jurado et al.
// 2014, the original dictionary); the data of the five rows is the number, from the highest bit on.
TEST(MarkerCells, SpellTheLengthOfTheSide) {
  for (const int side_mm : kMarkerSides_mm) {
    const auto cells = marker_cells(side_mm);
    ASSERT_EQ(cells.width(), 7);
    ASSERT_EQ(cells.height(), 7);
    int number = 0;
    for (int row = 1; row <= 5; ++row) number = 4 * number + 2 * cells(2, row) + cells(4, row);
    EXPECT_EQ(number, side_mm);
  }
}

TEST(MarkerCells, HaveABlackBorder) {
  for (const int side_mm : kMarkerSides_mm) {
    const auto cells = marker_cells(side_mm);
    for (int k = 0; k < 7; ++k)
      EXPECT_EQ(cells(k, 0) + cells(k, 6) + cells(0, k) + cells(6, k), 0) << side_mm << ", " << k;
  }
}

TEST(MarkerCells, DifferFromEveryOtherMarkerHoweverItIsTurned) {
  for (const int a : kMarkerSides_mm)
    for (const int b : kMarkerSides_mm)
      for (int turns = a == b ? 1 : 0; turns < 4; ++turns) {
        auto turned = marker_cells(b);
        for (int k = 0; k < turns; ++k) {
          const auto before = turned;
          for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 7; ++x) turned(x, y) = before(y, 6 - x);
        }
        EXPECT_NE(marker_cells(a), turned) << a << ", " << b << ", " << turns;
      }
}

// Pictures of markers are read in marker_scale_test.cpp.

}  // namespace
}  // namespace palpable::vision
