// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/carriageways.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

CentreLine straight(MapPoint a, MapPoint b, int first, int last, double radius_px) {
  CentreLine line{{}, first, last, radius_px, 0.1};
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i)
    line.points.push_back({a.x + (b.x - a.x) * i / kSteps, a.y + (b.y - a.y) * i / kSteps});
  return line;
}

CentreLines one_line(double radius_px) {
  return {{{0, 50}, {200, 50}}, {straight({0, 50}, {200, 50}, 0, 1, radius_px)}};
}

TEST(Carriageways, AStreetThatIsMuchWiderThanOthersHasTwo) {
  CentreLines wide = one_line(13.0);
  CentreLines others = one_line(6.0);
  divide_carriageways({&wide, &others});
  ASSERT_EQ(wide.lines.size(), 2U);
  EXPECT_EQ(others.lines.size(), 1U);
  EXPECT_NEAR(wide.lines[0].points[100].y, 56.5, 0.1);
  EXPECT_NEAR(wide.lines[1].points[100].y, 43.5, 0.1);
  EXPECT_NEAR(wide.lines[0].radius_px, 6.5, 1e-9);
}

TEST(Carriageways, AStreetThatDividesIntoTwoNarrowerOnesHasTwo) {
  CentreLines fork{{{0, 50}, {200, 50}, {400, 20}, {400, 80}},
                   {straight({0, 50}, {200, 50}, 0, 1, 10.0), straight({200, 50}, {400, 20}, 1, 2, 6.0),
                    straight({200, 50}, {400, 80}, 1, 3, 6.0)}};
  divide_carriageways({&fork});
  ASSERT_EQ(fork.lines.size(), 4U);
  // They end together at the junction.
  EXPECT_NEAR(fork.lines[0].points.back().y, 50.0, 1e-9);
  EXPECT_NEAR(fork.lines[3].points.back().y, 50.0, 1e-9);
  EXPECT_NEAR(fork.lines[0].points[100].y, 54.0, 0.1);
}

TEST(Carriageways, OtherStreetsStayOne) {
  CentreLines major = one_line(8.0);
  CentreLines minor = one_line(5.5);
  divide_carriageways({&major, &minor});
  EXPECT_EQ(major.lines.size(), 1U);
  CentreLines alone = one_line(13.0);
  divide_carriageways({&alone});
  EXPECT_EQ(alone.lines.size(), 1U);
}

}  // namespace
}  // namespace palpable::vision
