// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/numerals.hpp"

#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

TEST(Numerals, OfRulersAreNoLetters) {
  EXPECT_EQ(with_numerals("Avenue Albert Il"), "Avenue Albert II");
  EXPECT_EQ(with_numerals("Boulevard Rainier Ill"), "Boulevard Rainier III");
  EXPECT_EQ(with_numerals("Boulevard Rainier ill"), "Boulevard Rainier III");
  EXPECT_EQ(with_numerals("Boulevard Albert ler"), "Boulevard Albert 1er");
  EXPECT_EQ(with_numerals("Avenue Albert II"), "Avenue Albert II");
}

TEST(Numerals, OtherWordsStay) {
  for (const char* words :
       {"An der Ill", "Rue de l'Ill", "Illweg", "Il", "Route 11", "Old Mill", "Rue Keller", ""})
    EXPECT_EQ(with_numerals(words), words);
}

/// Upright strokes of 4 pixels, 8 pixels apart, in a picture of 30 pixels height.
cv::Mat strokes(int count) {
  cv::Mat picture(30, 8 * count + 4, CV_8U, cv::Scalar(255));
  for (int i = 0; i < count; ++i) picture(cv::Rect(4 + 8 * i, 2, 4, 26)) = 20;
  return picture;
}

TEST(Numerals, AreCountedByTheirStrokes) {
  EXPECT_EQ(numeral_or("If", strokes(3)), "III");
  EXPECT_EQ(numeral_or("HI", strokes(3)), "III");
  EXPECT_EQ(numeral_or("11", strokes(2)), "II");
  EXPECT_EQ(numeral_or("I", strokes(1)), "I");
  // Other letters, more strokes than a numeral has, and strokes that a bar joins: an H.
  EXPECT_EQ(numeral_or("Inn", strokes(4)), "Inn");
  EXPECT_EQ(numeral_or("Hub", strokes(3)), "Hub");
  cv::Mat barred = strokes(3);
  barred(cv::Rect(4, 13, 12, 4)) = 20;
  EXPECT_EQ(numeral_or("HI", barred), "HI");
  EXPECT_EQ(numeral_or("If", cv::Mat(4, 4, CV_8U, cv::Scalar(0))), "If");
}

}  // namespace
}  // namespace palpable::vision
