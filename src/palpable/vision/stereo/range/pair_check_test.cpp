// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/range/pair_check.hpp"

#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

Raster<std::uint8_t> textured(int lower_px, int left_px) {
  Raster<std::uint8_t> out(240, 160);
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 240; ++x)
      out(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * texture(x + left_px, y - lower_px, 0)));
  return out;
}

TEST(VerticalOffset, MeasuresALowerRightPicture) {
  const VerticalOffset offset = measure_vertical_offset(textured(0, 0), textured(4, 9), {});
  EXPECT_GT(offset.found, 50);
  EXPECT_EQ(offset.median_px, 4.0);
  EXPECT_EQ(offset.spread_px, 4.0);
}

TEST(VerticalOffset, IsZeroForAlignedPictures) {
  const VerticalOffset offset = measure_vertical_offset(textured(0, 0), textured(0, 9), {});
  EXPECT_EQ(offset.median_px, 0.0);
  EXPECT_EQ(offset.spread_px, 0.0);
}

TEST(PairNotes, AreEmptyForAGoodPair) {
  EXPECT_TRUE(pair_notes({2, 30, 0.6, 0.9}, {2, 30, 0.6, 0.9}, {0.0, 0.0, 150}, 1.2, 0.9).empty());
}

TEST(PairNotes, NameTheProblemWithItsFigure) {
  const auto says = [](const DisparityRange& range, const VerticalOffset& offset, double contrast,
                       const char* words) {
    const auto notes = pair_notes(range, range, offset, contrast, range.agreement > 0.1 ? 0.9 : 0.2);
    return notes.size() == 1 && notes.front().find(words) != std::string::npos;
  };
  EXPECT_TRUE(says({2, 30, 0.6, 0.9}, {5.0, 6.0, 150}, 1.2, "5 pixels lower"));
  EXPECT_TRUE(says({2, 30, 0.03, 0.9}, {0.0, 0.0, 150}, 1.2, "3.0 %"));
  EXPECT_TRUE(says({-30, 1, 0.6, 0.9}, {0.0, 0.0, 150}, 1.2, "exchanged"));
  EXPECT_TRUE(says({2, 30, 0.6, 0.01}, {0.0, 0.0, 150}, 1.2, "1.0 %"));
  EXPECT_TRUE(says({2, 30, 0.03, 0.9}, {0.0, 0.0, 150}, 0.25, "grain"));
}

TEST(PairNotes, FollowTheMatchedDepth) {
  const VerticalOffset none{0.0, 0.0, 150};
  EXPECT_TRUE(pair_notes({2, 30, 0.03, 0.9}, {2, 30, 0.03, 0.9}, none, 1.2, 0.9).empty());
  const auto guessed = pair_notes({-4, 6, 0.6, 0.9}, {2, 30, 0.6, 0.9}, none, 1.2, 0.6);
  ASSERT_EQ(guessed.size(), 1U);
  EXPECT_NE(guessed.front().find("40 % of the picture is guessed"), std::string::npos);
  EXPECT_NE(guessed.front().find("from 2 to 30 pixels"), std::string::npos);
}

TEST(PairNotes, ObeyTheirThresholds) {
  PairCheckOptions options;
  for (const Parameter& p : parameters_of(options)) EXPECT_TRUE(set_parameter(p, p.get())) << p.name;
  options.misaligned_px = 7.0;
  options.most_guessed = 1.0;
  EXPECT_TRUE(pair_notes({2, 30, 0.6, 0.9}, {2, 30, 0.6, 0.9}, {5.0, 6.0, 150}, 1.2, 0.2, options).empty());
  options.least_agreement = 0.02;
  EXPECT_TRUE(pair_notes({2, 30, 0.03, 0.9}, {2, 30, 0.03, 0.9}, {0.0, 0.0, 150}, 1.2, 0.2, options).empty());
  options.least_texture = 0.95;
  EXPECT_EQ(pair_notes({2, 30, 0.6, 0.9}, {2, 30, 0.6, 0.9}, {0.0, 0.0, 150}, 1.2, 0.2, options).size(), 1U);
}

TEST(ContrastBeyondGrain, IsLowForNoiseAndHighForAPicture) {
  Raster<std::uint8_t> noise(160, 120), smooth(160, 120);
  std::uint32_t state = 1;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      state = state * 1664525U + 1013904223U;
      noise(x, y) = static_cast<std::uint8_t>(state >> 24U);
      smooth(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * texture(x / 10.0, y / 10.0, 0)));
    }
  EXPECT_NEAR(contrast_beyond_grain(noise), 0.25, 0.08);
  EXPECT_GT(contrast_beyond_grain(smooth), 1.0);
}

TEST(PairCheck, SaysThatAPairIsFlat) {
  EXPECT_FALSE(flat_note(1.5));
  const auto note = flat_note(0.04);
  ASSERT_TRUE(note);
  EXPECT_NE(note->find("only 0.0 pixels"), std::string::npos);
}

}  // namespace
}  // namespace palpable::vision
