// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/height_lines.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

Raster<float> cone() {
  Raster<float> z(61, 41);
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 61; ++x)
      z(x, y) = static_cast<float>(std::max(0.0, 0.010 - 0.0005 * std::hypot(x - 30.0, y - 20.0)));
  return z;
}

TEST(HeightLines, OfAConeAreClosedRings) {
  HeightLineOptions options;
  options.interval_m = 0.002;
  const auto lines = height_lines(cone(), 0.001, options);
  ASSERT_TRUE(lines);
  ASSERT_EQ(lines->size(), 5U);
  for (const HeightLine& ring : *lines)
    EXPECT_NEAR(norm(ring.line.points.front() - ring.line.points.back()), 0.0, 1e-9);
  options.interval_m = 0.0;
  EXPECT_FALSE(height_lines(cone(), 0.001, options));
  options.interval_m = 1e-6;
  EXPECT_FALSE(height_lines(cone(), 0.001, options));
}

TEST(HeightLines, BeginWithAnOutlineAboveTheGround) {
  // A cone of 10 mm: its outline, and lines at 2, 4, 6 and 8 mm, the longest first.
  HeightLineOptions options;
  options.outline_m = 0.0005;
  const auto lines = height_lines(cone(), 0.001, options);
  ASSERT_TRUE(lines);
  ASSERT_EQ(lines->size(), 5U);
  EXPECT_EQ((*lines)[0].weight, 1.5);
  for (std::size_t k = 1; k < 5; ++k) {
    EXPECT_EQ((*lines)[k].weight, 1.0);
    EXPECT_LT(length_of((*lines)[k].line), length_of((*lines)[k - 1].line));
  }
}

TEST(HeightLines, GoOnAlongTheBorderOfWhatEndsThere) {
  // A plate of 5 mm that reaches the lower border.
  Raster<float> plate(40, 30);
  for (int y = 10; y < 30; ++y)
    for (int x = 10; x < 30; ++x) plate(x, y) = 0.005F;
  HeightLineOptions options;
  options.outline_m = 0.0025, options.interval_m = 1.0;
  const auto ends_apart = [&] {
    const auto lines = height_lines(plate, 0.001, options);
    EXPECT_EQ(lines->size(), 1U);
    return norm((*lines)[0].line.points.front() - (*lines)[0].line.points.back());
  };
  EXPECT_NEAR(ends_apart(), 0.020, 1e-6);
  options.beyond = HeightLineOptions::Beyond::lowest;
  EXPECT_NEAR(ends_apart(), 0.0, 1e-9);
  const auto closed = height_lines(plate, 0.001, options);
  ASSERT_TRUE(closed);
  double lowest = 1.0;
  for (const Vec3 p : closed->front().line.points) lowest = std::min(lowest, p.y);
  EXPECT_NEAR(lowest, -0.015, 1e-9);
}

TEST(HeightLines, LeaveOutShortLines) {
  HeightLineOptions options;
  options.outline_m = 0.0005;
  // The line at 8 mm is a ring of 4 mm radius, 25 mm long.
  options.least_length_m = 0.030;
  EXPECT_EQ(height_lines(cone(), 0.001, options)->size(), 4U);
}

TEST(HeightLines, OfASmoothedSurfaceHaveNoFineDetail) {
  // A plate of 5 mm with a tooth of 2 mm.
  Raster<float> plate(60, 60);
  for (int y = 20; y < 40; ++y)
    for (int x = 20; x < 40; ++x) plate(x, y) = 0.005F;
  plate(30, 19) = plate(31, 19) = plate(30, 18) = plate(31, 18) = 0.005F;
  HeightLineOptions options;
  options.outline_m = 0.0025, options.interval_m = 1.0;
  const auto fine = height_lines(plate, 0.001, options);
  options.smooth_m = 0.008;
  const auto smooth = height_lines(plate, 0.001, options);
  ASSERT_TRUE(fine && smooth);
  ASSERT_EQ(smooth->size(), 1U);
  const auto top_of = [](const HeightLine& line) {
    double top = -1.0;
    for (const Vec3 p : line.line.points) top = std::max(top, p.y);
    return top;
  };
  EXPECT_NEAR(top_of((*fine)[0]), 0.012, 1e-6);
  EXPECT_NEAR(top_of((*smooth)[0]), 0.010, 8e-4);
  options.smooth_m = 1.0;
  EXPECT_FALSE(height_lines(plate, 0.001, options));
}

TEST(HeightLines, ArePolylinesFromTheMiddle) {
  // A ramp along x from 0 to 10 mm over 11 samples of 1 mm: its line at 5 mm is x = 0.
  Raster<float> ramp(11, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 11; ++x) ramp(x, y) = 0.001F * static_cast<float>(x);
  HeightLineOptions options;
  options.interval_m = 0.01;
  const auto lines = height_lines(ramp, 0.001, options);
  ASSERT_TRUE(lines);
  ASSERT_EQ(lines->size(), 1U);
  for (const Vec3 point : (*lines)[0].line.points) EXPECT_NEAR(point.x, 0.0, 1e-9);
  EXPECT_NEAR(std::abs((*lines)[0].line.points.front().y), 0.002, 1e-9);
  options.interval_m = 0.0;
  EXPECT_FALSE(height_lines(ramp, 0.001, options));
}

}  // namespace
}  // namespace palpable::formats
