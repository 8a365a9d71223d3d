// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_corners.hpp"

#include "palpable/vision/contours/contours.hpp"
#include "palpable/vision/contours/drawn_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kSize = 96;
constexpr double kMiddle = 47.5;

/// A polygon of equal sides, its corners 34 px from (kMiddle + dx, kMiddle - dx / 2).
struct Polygon {
  int corners;
  double turned_deg;
  double dx;

  double corner(int k, bool of_y) const {
    const double angle = (turned_deg + 360.0 * k / corners) * std::numbers::pi / 180.0;
    return of_y ? kMiddle - dx / 2 + 34.0 * std::sin(angle) : kMiddle + dx + 34.0 * std::cos(angle);
  }
  bool contains(double x, double y) const {
    for (int k = 0; k < corners; ++k) {
      const double ax = corner(k, false), ay = corner(k, true);
      const double bx = corner(k + 1, false), by = corner(k + 1, true);
      if ((bx - ax) * (y - ay) - (by - ay) * (x - ax) < 0.0) return false;
    }
    return true;
  }
};

ContourMap contours_of(const Shape& shape) {
  auto found = find_contours(drawn(kSize, shape, 8), {}, {});
  EXPECT_TRUE(found);
  return std::move(*found);
}

/// Distance from a point to the nearest pixel of the line.
double to_line(const Raster<float>& line, double x, double y) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int v = 0; v < line.height(); ++v)
    for (int u = 0; u < line.width(); ++u)
      if (line(u, v) > 0.0F) nearest = std::min(nearest, std::hypot(u - x, v - y));
  return nearest;
}

TEST(ContourCorners, AreAccurateToAPixel) {
  for (const int corners : {3, 4, 5, 6, 8})
    for (const double turned : {0.0, 7.0, 22.5, 40.0}) {
      const Polygon polygon{corners, turned, 0.37};
      const ContourMap found = contours_of([&](double x, double y) { return polygon.contains(x, y); });
      for (int k = 0; k < corners; ++k)
        EXPECT_LE(to_line(found.line, polygon.corner(k, false), polygon.corner(k, true)), 1.0)
            << corners << " corners, turned by " << turned << ", corner " << k;
    }
}

TEST(ContourCorners, KeepArcs) {
  for (const double radius : {6.0, 10.0, 15.0, 25.0, 40.0}) {
    const ContourMap found =
        contours_of([&](double x, double y) { return std::hypot(x - kMiddle, y - kMiddle - 0.2) < radius; });
    Raster<float> again = found.line;
    restore_corners(found.strength, found.tangent_x, found.tangent_y, again, {}, {});
    EXPECT_EQ(again, found.line);
    int pixels = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        if (!(found.line(x, y) > 0.0F)) continue;
        ++pixels;
        EXPECT_NEAR(std::hypot(x - kMiddle, y - kMiddle - 0.2), radius, 0.9) << "radius " << radius;
      }
    EXPECT_GE(pixels, static_cast<int>(4.0 * radius));
  }
}

TEST(ContourCorners, LeaveNoGapBesideThem) {
  const Polygon square{4, 22.5, 0.0};
  const ContourMap found = contours_of([&](double x, double y) { return square.contains(x, y); });
  // Near every point of each side there is a pixel of the line.
  for (int k = 0; k < 4; ++k)
    for (double share = 0.0; share <= 1.0; share += 0.02)
      EXPECT_LE(
          to_line(found.line, square.corner(k, false) * (1 - share) + square.corner(k + 1, false) * share,
                  square.corner(k, true) * (1 - share) + square.corner(k + 1, true) * share),
          1.0);
}

}  // namespace
}  // namespace palpable::vision
