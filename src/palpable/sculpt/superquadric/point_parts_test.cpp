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

TEST(PointNeck, IsWhereFewPointsJoinTwoBodies) {
  // A plate of 10 x 10 points, a bridge of 3, and a plate of 6 x 6.
  std::vector<Vec3> points;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y) points.push_back({1.0 * x, 1.0 * y, 0.0});
  for (int x = 10; x < 13; ++x) points.push_back({1.0 * x, 4.0, 0.0});
  for (int x = 13; x < 19; ++x)
    for (int y = 1; y < 7; ++y) points.push_back({1.0 * x, 1.0 * y, 0.0});
  for (const Members& side : cut_at_neck(points, all_of(points), 1.5)) {
    const bool left = points[side.front()].x < 9.5;
    for (const std::uint32_t i : side) EXPECT_TRUE(left ? points[i].x < 13.0 : points[i].x > 9.0);
    EXPECT_GE(side.size(), 36U);
  }
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
