// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/contours/junctions.hpp"

#include <cmath>
#include <initializer_list>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

struct Stroke {
  double x0, y0, x1, y1;
};

Raster<float> drawn(std::initializer_list<Stroke> strokes) {
  Raster<float> line(120, 100, 0.0F);
  for (const Stroke& s : strokes)
    for (int k = 0; k <= 400; ++k) {
      const double f = k / 400.0;
      line(static_cast<int>(std::lround(s.x0 + f * (s.x1 - s.x0))),
           static_cast<int>(std::lround(s.y0 + f * (s.y1 - s.y0)))) = 1.0F;
    }
  return line;
}

TEST(Junctions, AreWhereThreeOrFourLinesMeet) {
  const auto tee = find_junctions(drawn({{20, 50, 100, 50}, {60, 50, 60, 90}}), {});
  ASSERT_EQ(tee.size(), 1U);
  EXPECT_NEAR(tee[0].x_px, 60, 1.5);
  EXPECT_NEAR(tee[0].y_px, 50, 3.0);
  EXPECT_EQ(tee[0].branches, 3);
  const auto cross = find_junctions(drawn({{20, 20, 90, 80}, {90, 20, 20, 80}}), {});
  ASSERT_EQ(cross.size(), 1U);
  EXPECT_NEAR(cross[0].x_px, 55, 1.5);
  EXPECT_EQ(cross[0].branches, 4);
}

TEST(Junctions, BridgeTheGapThatThinningLeaves) {
  EXPECT_EQ(find_junctions(drawn({{20, 50, 100, 50}, {60, 53, 60, 90}}), {}).size(), 1U);
  EXPECT_TRUE(find_junctions(drawn({{20, 50, 100, 50}, {60, 57, 60, 90}}), {}).empty());
}

TEST(Junctions, AreNeitherCornersNorEndsNorLinesThatPassBy) {
  EXPECT_TRUE(find_junctions(drawn({{20, 50, 60, 50}, {60, 50, 60, 90}}), {}).empty());
  EXPECT_TRUE(find_junctions(drawn({{20, 50, 100, 50}, {20, 55, 100, 55}}), {}).empty());
  EXPECT_TRUE(find_junctions(drawn({{20, 50, 40, 52}}), {}).empty());
  EXPECT_TRUE(find_junctions(drawn({}), {}).empty());
}

/// Two rings around the middle, as the two sides of a stroke.
Raster<float> ring(double outer_px, double inner_px) {
  Raster<float> line(200, 200, 0.0F);
  for (const double radius : {outer_px, inner_px})
    for (int k = 0; k < 4000; ++k) {
      const double a = 2.0 * 3.14159265358979 * k / 4000.0;
      line(static_cast<int>(std::lround(100.0 + radius * std::cos(a))),
           static_cast<int>(std::lround(100.0 + radius * std::sin(a)))) = 1.0F;
    }
  return line;
}

TEST(Junctions, AreNotOnARingDrawnWithAThickStroke) {
  for (const double width_px : {2.0, 2.6, 3.0, 3.4, 4.0, 4.6, 6.0})
    EXPECT_TRUE(find_junctions(ring(82.0, 82.0 - width_px), {10, 3, 1}).empty()) << width_px;
}

TEST(Junctions, AreWhereThickStrokesCross) {
  EXPECT_FALSE(find_junctions(drawn({{20, 48, 58, 48},
                                     {61, 48, 100, 48},
                                     {20, 51, 58, 51},
                                     {61, 51, 100, 51},
                                     {58, 20, 58, 48},
                                     {61, 20, 61, 48},
                                     {58, 51, 58, 90},
                                     {61, 51, 61, 90}}),
                              {})
                   .empty());
}

TEST(Junctions, AreMarkedByDiscs) {
  const auto labels = mark_junctions({{60.0, 50.0, 3}, {0.0, 0.0, 3}}, 120, 100, 5.0, 7);
  EXPECT_EQ(labels(60, 50), 7);
  EXPECT_EQ(labels(64, 52), 7);
  EXPECT_EQ(labels(66, 50), 0);
  EXPECT_EQ(labels(0, 0), 7);
}

}  // namespace
}  // namespace palpable::sculpt
