// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/rectifying_rotations.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// The match of a point in a pair whose right camera is rotated in its plane; in the right picture it is
/// `raised_px` above its row.
FeatureMatch seen_turned(double x, double y, double disparity_px, double raised_px) {
  constexpr double kTurn = 0.03;
  const double u = x - disparity_px - 319.5, v = y - raised_px - 239.5;
  return {x, y, 319.5 + std::cos(kTurn) * u - std::sin(kTurn) * v,
          239.5 + std::sin(kTurn) * u + std::cos(kTurn) * v};
}

TEST(RectifyingRotations, SelectTheAlternativeThatFitsTheOtherMatches) {
  // A board of 12 x 10 squares whose rows rise by a pixel in 20: each corner also resembles its neighbours.
  // The surroundings are distinct.
  constexpr double kSquare_px = 30.0, kRise = 0.05, kBoard_px = 60.0;
  std::vector<FeatureMatch> matches, truth;
  for (int i = 0; i < 40; ++i)
    truth.push_back(seen_turned(20.0 + 15.0 * i, i % 2 == 0 ? 30.0 + i : 440.0 - i, 12.0 + i % 7, 0.0));
  matches = truth;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 12; ++i) {
      const double x = 150.0 + kSquare_px * i, y = 100.0 + kSquare_px * j - kRise * x;
      for (const int aside : {-1, 1, 0})
        matches.push_back(seen_turned(x, y, kBoard_px - kSquare_px * aside, kRise * kSquare_px * aside));
      truth.push_back(matches.back());
    }
  const auto found = find_rectifying_rotations(matches, unknown_camera(640, 480), 1.5, 1);
  ASSERT_EQ(found.inliers.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_EQ(found.inliers[i].right_x, truth[i].right_x) << i;
  EXPECT_LT(vertical_rms_px(rectified_matches(found.inliers, found.transform)), 0.05);
}

}  // namespace
}  // namespace palpable::vision
