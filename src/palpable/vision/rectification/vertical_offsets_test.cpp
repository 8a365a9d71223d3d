// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/vertical_offsets.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kPairWidth = 640, kPairHeight = 480;

/// A wave over the rows, as from a rolling shutter in a moving hand.
double offset_of(double y) { return 2.0 + 3.0 * std::sin(y / 60.0); }

/// Matches with that offset and noise; one in `wrong_each` is an outlier.
std::vector<FeatureMatch> rolling_matches(int wrong_each) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(0, kPairWidth), y(0, kPairHeight), anywhere(-40.0, 40.0);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::vector<FeatureMatch> matches;
  for (int i = 0; i < 800; ++i) {
    const double left_x = x(random), left_y = y(random);
    const double off = i % wrong_each == 0 ? anywhere(random) : offset_of(left_y) + noise(random);
    matches.push_back({left_x, left_y, left_x - 10.0, left_y + off});
  }
  return matches;
}

TEST(VerticalOffsets, FollowAWaveOverTheRowsDespiteOutliers) {
  const auto offsets = VerticalOffsets::through(rolling_matches(6), kPairWidth, kPairHeight);
  ASSERT_TRUE(offsets);
  double squares = 0.0;
  int places = 0;
  for (int y = 20; y < kPairHeight - 20; y += 10)
    for (int x = 40; x < kPairWidth - 40; x += 40) {
      const double off = offsets->offset_px(x, y) - offset_of(y);
      squares += off * off;
      ++places;
    }
  EXPECT_LT(std::sqrt(squares / places), 0.15);
  const FeatureMatch corrected = offsets->corrected({300, 200, 290, 200 + offset_of(200)});
  EXPECT_NEAR(corrected.right_y, 200.0, 0.3);
}

TEST(VerticalOffsets, NeedEnoughMatches) {
  auto matches = rolling_matches(100);
  matches.resize(99);
  EXPECT_FALSE(VerticalOffsets::through(matches, kPairWidth, kPairHeight));
}

TEST(VerticalOffsets, AreCrossValidatedAgainstAnotherModel) {
  const VerticalOffsetScore score = cross_validate_offsets(rolling_matches(6), kPairWidth, kPairHeight, 1.5);
  EXPECT_GT(score.inliers, 600U);
  EXPECT_LT(score.residual_px, 0.3);
  EXPECT_GT(score.greatest_px, 2.0);
  EXPECT_TRUE(score.is_better_than(300, 1.0, {}));
  EXPECT_FALSE(score.is_better_than(score.inliers, 0.1, {}));
}

}  // namespace
}  // namespace palpable::vision
