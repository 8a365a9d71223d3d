// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"

#include "palpable/vision/contours/drawn_shape.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr int kSize = 112;
constexpr double kPixel_m = 0.001;
constexpr double kCentre_px = 55.3;

/// A disc's boundary map, a millimetre a pixel.
models::BoundaryMap map_of_disc(double radius_px, double neighbourhood_px) {
  const auto contours = vision::find_contours(
      vision::drawn(
          kSize, [&](double x, double y) { return std::hypot(x - kCentre_px, y - kCentre_px) < radius_px; }),
      {}, {});
  EXPECT_TRUE(contours);
  BoundaryMapOptions options;
  options.width_m = options.height_m = kPixel_m * kSize;
  options.radius_px = neighbourhood_px;
  auto map = boundary_map_from_contours(*contours, options, {});
  EXPECT_TRUE(map);
  return std::move(*map);
}

/// The tangent's angle at an angle on a circle about the disc's centre.
double direction_at(const models::BoundaryMap& map, double radius_px, double angle) {
  const double middle = 0.5 * (kSize - 1);
  const double x = kCentre_px + radius_px * std::cos(angle) - middle;
  const double y = kCentre_px + radius_px * std::sin(angle) - middle;
  const models::BoundarySample b = map.sample(x * kPixel_m, -y * kPixel_m);
  return std::atan2(b.tangent_y, b.tangent_x);
}

TEST(BoundaryMapFromPicture, TurnsHardlyMoreThanItsContourFromPixelToPixel) {
  for (const double neighbourhood : {1.0, 3.0, 6.0})
    for (const double radius : {6.0, 10.0, 20.0, 40.0}) {
      const models::BoundaryMap map = map_of_disc(radius, neighbourhood);
      for (const double beside : {-1.0, 0.0, 1.0}) {
        const double own = 1.0 / (radius + beside);
        for (double angle = 0.0; angle < 2.0 * std::numbers::pi; angle += own) {
          const double turn = std::remainder(
              direction_at(map, radius + beside, angle + own) - direction_at(map, radius + beside, angle),
              std::numbers::pi);
          // On radius 6: 0.31 degrees a pixel on the contour when written, 0.62 a pixel outside.
          EXPECT_LE((std::abs(turn) - own) * 180.0 / std::numbers::pi, beside == 0.0 ? 0.5 : 0.7)
              << "radius " << radius << ", " << beside << " px beside";
        }
      }
    }
}

}  // namespace
}  // namespace palpable::sculpt
