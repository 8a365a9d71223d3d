// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/numbers.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

TEST(Numbers, HaveNoExponentNoZeroAtTheEndAndNoMinusZero) {
  for (double decade = 1e-8; decade < 1e9; decade *= 10.0) {
    for (const double factor : {1.0, -1.0, 1.06, 2.5, -9.96, 9.999}) {
      const std::string text = figure(factor * decade);
      EXPECT_EQ(text.find_first_of("eE"), std::string::npos) << text;
      EXPECT_NE(text, "-0");
      if (text.find('.') != std::string::npos) {
        EXPECT_NE(text.back(), '0') << text;
        EXPECT_NE(text.back(), '.') << text;
      }
    }
  }
}

TEST(Numbers, AreRoundedToTheirDigitsAndNoMore) {
  for (double value = 1e-6; value < 1e6; value *= 1.37)
    for (const int digits : {1, 2, 3})
      EXPECT_NEAR(std::stod(figure(value, digits)), value, 0.51 * value * std::pow(10.0, 1 - digits))
          << figure(value, digits);
}

TEST(Numbers, KeepEveryDigitBeforeThePoint) {
  EXPECT_EQ(figure(110.4), "110");
  EXPECT_EQ(figure(1234.0), "1234");
  EXPECT_EQ(figure(3.44), "3.4");
  EXPECT_EQ(figure(0.254), "0.25");
  EXPECT_EQ(figure(1.0), "1");
  EXPECT_EQ(figure(-0.0), "0");
  EXPECT_EQ(figure(1e-12), "0");
  EXPECT_EQ(figure(std::numeric_limits<double>::quiet_NaN()), "unknown");
}

TEST(Numbers, LengthsChangeTheirUnitAtAMetre) {
  EXPECT_EQ(length(0.11), "110 mm");
  EXPECT_EQ(length(0.0034), "3.4 mm");
  EXPECT_EQ(length(0.00025), "0.25 mm");
  EXPECT_EQ(length(1.25), "1.25 m");
  EXPECT_EQ(length(0.9999), "1 m");
}

TEST(Numbers, SpokenLengthsHaveAPluralAndATenthBelowTen) {
  EXPECT_EQ(spoken_length(0.001), "1 millimetre");
  EXPECT_EQ(spoken_length(0.00101), "1 millimetre");
  EXPECT_EQ(spoken_length(0.0094), "9.4 millimetres");
  EXPECT_EQ(spoken_length(0.00996), "10 millimetres");
  EXPECT_EQ(spoken_length(0.0126), "13 millimetres");
  EXPECT_EQ(spoken_length(-0.001), "minus 1 millimetre");
  EXPECT_EQ(spoken_length(-0.00001), "0 millimetres");
  EXPECT_EQ(spoken_length(0.00004), "0 millimetres");
  EXPECT_EQ(spoken_length(1.0), "1 metre");
  EXPECT_EQ(spoken_length(1.254), "1.25 metres");
}

TEST(Numbers, SpokenLengthsAreRightOverTheirWholeRange) {
  for (double metres = 1e-4; metres < 0.99; metres *= 1.13) {
    const std::string text = spoken_length(metres);
    EXPECT_NEAR(std::stod(text), 1e3 * metres, metres < 0.00995 ? 0.0501 : 0.501) << text;
    EXPECT_NE(text.find("millimetre"), std::string::npos);
  }
}

TEST(Numbers, TwoLengthsShareTheirUnit) {
  EXPECT_EQ(spoken_lengths(0.1, "by", 0.075), "100 by 75 millimetres");
  EXPECT_EQ(spoken_lengths(0.001, "to", 0.013), "1 to 13 millimetres");
  EXPECT_EQ(spoken_lengths(-0.013, "to", -0.001), "minus 13 millimetres to minus 1 millimetre");
  EXPECT_EQ(spoken_lengths(0.5, "by", 2.0), "500 millimetres by 2 metres");
}

TEST(Numbers, ForcesAndAnglesHaveTheirUnits) {
  EXPECT_EQ(spoken_force(1.0), "1 newton");
  EXPECT_EQ(spoken_force(0.254), "0.25 newtons");
  EXPECT_EQ(spoken_angle(std::numbers::pi / 12.0), "15 degrees");
  EXPECT_EQ(spoken_angle(-std::numbers::pi / 180.0), "1 degree");
  EXPECT_EQ(spoken_angle(0.0), "0 degrees");
}

TEST(Words, AreCountedAndListed) {
  EXPECT_EQ(counted(0, "line", "lines"), "no lines");
  EXPECT_EQ(counted(1, "line", "lines"), "1 line");
  EXPECT_EQ(counted(12, "line", "lines"), "12 lines");
  const std::array<std::string, 3> words{"A.png", "B.png", "C.png"};
  EXPECT_EQ(listed(words), "A.png, B.png and C.png");
  EXPECT_EQ(listed(std::span(words).first(2)), "A.png and B.png");
  EXPECT_EQ(listed(std::span(words).first(1)), "A.png");
  EXPECT_EQ(capitalised("upper left"), "Upper left");
}

}  // namespace
}  // namespace palpable::describe
