// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/closed_line.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

const std::vector<Vec3> kSquare{{0, 0, 0}, {0.01, 0, 0}, {0.01, 0.01, 0}, {0, 0.01, 0}};

TEST(LineByLength, IsPeriodicWhenClosedAndClampedWhenOpen) {
  const LineByLength closed(kSquare, LineByLength::Ends::closed);
  EXPECT_NEAR(closed.length_m(), 0.04, 1e-12);
  EXPECT_NEAR(norm(closed.point(0.045) - Vec3{0.005, 0, 0}), 0.0, 1e-12);
  const LineByLength open(kSquare, LineByLength::Ends::open);
  EXPECT_NEAR(open.length_m(), 0.03, 1e-12);
  EXPECT_NEAR(norm(open.point(0.045) - Vec3{0, 0.01, 0}), 0.0, 1e-12);
}

TEST(LineByLength, FindsTheNearestPointAndTheNextCorner) {
  const LineByLength line(kSquare, LineByLength::Ends::closed);
  EXPECT_NEAR(line.nearest({0.0042, 0.001, 0}, 0.0, 0.008), 0.0042, 1e-4);
  EXPECT_NEAR(line.next_corner(0.001), 0.01, 1e-12);
  EXPECT_NEAR(line.next_corner(0.0101), 0.02, 1e-12);
  EXPECT_TRUE(std::isinf(line.next_corner(0.035)));
}

TEST(AreaError, IsTheAreaBetweenTheLinesOverTheAreaInside) {
  EXPECT_EQ(area_error(kSquare, kSquare), 0.0);
  std::vector<Vec3> wider = kSquare;
  for (Vec3& p : wider) p.x *= 1.1;
  EXPECT_NEAR(area_error(wider, kSquare), 0.10, 0.005);
  std::vector<Vec3> beside = kSquare;
  for (Vec3& p : beside) p.x += 0.02;
  EXPECT_NEAR(area_error(beside, kSquare), 2.0, 0.02);
  EXPECT_TRUE(std::isnan(area_error(kSquare, {{0, 0, 0}, {0.01, 0, 0}})));
}

TEST(Roughness, IsZeroOnAStraightLineAndTheTurningAngleOnASquare) {
  EXPECT_EQ(roughness_deg_per_mm({{0, 0, 0}, {0.01, 0, 0}, {0.03, 0, 0}}), 0.0);
  EXPECT_NEAR(roughness_deg_per_mm(kSquare), 2 * 90.0 / 20.0, 1e-9);
}

}  // namespace
}  // namespace palpable::study
