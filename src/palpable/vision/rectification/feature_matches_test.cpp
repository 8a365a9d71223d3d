// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/feature_matches.hpp"

#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A texture shifted by 9 px to the left and 4 px down.
StereoPair moved_pair() {
  SyntheticScene scene;
  scene.width = 320;
  scene.height = 240;
  scene.ground_px = 9.0;
  scene.box_left = scene.box_right = 0;
  scene.right_lower_px = 4;
  return render(scene);
}

TEST(MatchFeatures, FindsTheShiftOfATexture) {
  const auto matches = match_features(moved_pair());
  ASSERT_GT(matches.size(), 50U);
  std::size_t right = 0;
  for (const FeatureMatch& m : matches)
    right +=
        std::abs(m.left_x - m.right_x - 9.0) < 0.5 && std::abs(m.right_y - m.left_y - 4.0) < 0.5 ? 1U : 0U;
  EXPECT_GT(static_cast<double>(right), 0.9 * static_cast<double>(matches.size()));
  EXPECT_NEAR(vertical_rms_px({{10, 5, 3, 8}, {20, 6, 9, 2}}), std::sqrt(12.5), 1e-12);
  EXPECT_TRUE(std::isnan(vertical_rms_px({})));
}

TEST(MatchFeatures, TolerateMoreInLargePicturesWhichAreReduced) {
  EXPECT_DOUBLE_EQ(feature_tolerance_px(1600, 900), 1.5);
  EXPECT_DOUBLE_EQ(feature_tolerance_px(4000, 3000), 4.5);
}

}  // namespace
}  // namespace palpable::vision
