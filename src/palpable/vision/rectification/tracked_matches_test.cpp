// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/tracked_matches.hpp"

#include "palpable/vision/stereo/problem/centred_box.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(TrackedMatches, AddCornersWithTheSurfacesDisparity) {
  const StereoPair pair = render(centred_box_scene(320, 240));
  const std::vector<FeatureMatch> known{{50, 50, 44, 50}, {160, 120, 146, 120}};
  const auto matches = tracked_matches(pair, known, {});
  ASSERT_TRUE(matches);
  std::size_t right = 0;
  for (const FeatureMatch& m : *matches) {
    const double d = m.left_x - m.right_x;
    right += std::min(std::abs(d - 6.0), std::abs(d - 14.0)) < 0.5 && std::abs(m.right_y - m.left_y) < 0.5
                 ? 1U
                 : 0U;
  }
  EXPECT_GT(right, 100U);
  // Alternatives of a corner follow it in the list; only few are added.
  EXPECT_GT(static_cast<double>(right), 0.8 * static_cast<double>(matches->size()));
}

TEST(TrackedMatches, AreEmptyWithoutAKnownMatch) {
  const auto matches = tracked_matches(render({}), {}, {});
  ASSERT_TRUE(matches);
  EXPECT_TRUE(matches->empty());
}

}  // namespace
}  // namespace palpable::vision
