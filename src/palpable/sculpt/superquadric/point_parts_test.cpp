// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/point_parts.hpp"

#include <numeric>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// Two rows of ten points, 1 m apart; the rows are 5 m apart.
std::vector<Vec3> two_rows() {
  std::vector<Vec3> points;
  for (int row = 0; row < 2; ++row)
    for (int k = 0; k < 10; ++k) points.push_back({1.0 * k, 5.0 * row, 0.0});
  return points;
}

Members all_of(const std::vector<Vec3>& points) {
  Members members(points.size());
  std::iota(members.begin(), members.end(), 0U);
  return members;
}

TEST(PointPieces, AreConnectedByGapsUpToTheGivenOne) {
  const auto points = two_rows();
  EXPECT_EQ(pieces_of(points, all_of(points), 1.5).size(), 2U);
  EXPECT_EQ(pieces_of(points, all_of(points), 6.0).size(), 1U);
  EXPECT_EQ(pieces_of(points, all_of(points), 0.5).size(), 20U);
  const auto pieces = pieces_of(points, all_of(points), 1.5);
  EXPECT_EQ(pieces[0], (Members{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(PointHalves, AreDividedAcrossTheLongestExtent) {
  std::vector<Vec3> row;
  for (int k = 0; k < 10; ++k) row.push_back({1.0 * k, 0.0, 0.0});
  const auto halves = halved(row, all_of(row));
  EXPECT_EQ(halves[0].size(), 5U);
  EXPECT_EQ(halves[1].size(), 5U);
  const Members low{0, 1, 2, 3, 4};
  EXPECT_TRUE(halves[0] == low || halves[1] == low);
}

TEST(ThinnedPoints, AreAllIfTheyAreFewAndOneACellElse) {
  const auto points = two_rows();
  EXPECT_EQ(thinned(points, 20).size(), 20U);
  const Members few = thinned(points, 8);
  EXPECT_LE(few.size(), 8U);
  EXPECT_GE(few.size(), 4U);
}

}  // namespace
}  // namespace palpable::sculpt
