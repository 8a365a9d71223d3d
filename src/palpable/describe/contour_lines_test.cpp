// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/contour_lines.hpp"

#include "palpable/describe/test_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::describe {
namespace {

const models::BoundaryMap& boundaries(const models::Scene& scene) {
  return std::get<std::shared_ptr<const models::Contours>>(scene.model)->boundaries;
}

TEST(ContourLines, HaveLengthPlaceAndClosedness) {
  const auto scene = circle_and_line();
  const auto lines = find_contour_lines(boundaries(scene)).lines;
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_NEAR(lines[0].length_m, 2.0 * std::numbers::pi * 0.02, 0.003);
  EXPECT_NEAR(lines[0].middle().x_m, -0.02, 0.001);
  EXPECT_NEAR(lines[0].middle().y_m, 0.02, 0.001);
  EXPECT_NEAR(lines[0].most.x_m - lines[0].least.x_m, 0.04, 0.001);
  EXPECT_FALSE(lines[1].closed);
  EXPECT_NEAR(lines[1].length_m, 0.06, 0.002);
  EXPECT_NEAR(lines[1].middle().y_m, -0.02, 0.001);
}

TEST(ContourLines, AnOpenLineInsideAClosedOneStaysOpen) {
  constexpr int kSide = 100;
  Raster<models::BoundaryPixel> edges(kSide, kSide);
  for (int i = 10; i < 90; ++i) edges(i, 10) = edges(i, 89) = edges(10, i) = edges(89, i) = {1.0F, 0.0F};
  for (int i = 30; i < 70; ++i) edges(i, 50) = {1.0F, 0.0F};
  const auto map = models::BoundaryMap::from_edges(std::move(edges), 0.001, 2.0, {0.5, 0.01}, Work{});
  ASSERT_TRUE(map);
  const auto lines = find_contour_lines(*map).lines;
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_FALSE(lines[1].closed);
}

/// Lines on 400 x 400 pixels of 0.25 mm; `on(x, y)` in mm from the middle, y up.
template <class On>
models::BoundaryMap drawing(const On& on) {
  constexpr int kSide = 400;
  Raster<models::BoundaryPixel> edges(kSide, kSide);
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      if (on(0.25 * (i - 199.5), 0.25 * (199.5 - j))) edges(i, j) = {1.0F, 0.0F};
  return *models::BoundaryMap::from_edges(std::move(edges), 0.00025, 2.0, {0.5, 0.01}, Work{});
}

TEST(ContourLines, CrossingLinesAreNotClosed) {
  const auto cross = find_contour_lines(drawing([](double x, double y) {
    return (std::abs(x) < 0.8 && std::abs(y) < 35) || (std::abs(y) < 0.8 && std::abs(x) < 30);
  }));
  ASSERT_EQ(cross.lines.size(), 2U);
  EXPECT_FALSE(cross.lines[0].closed);
  EXPECT_FALSE(cross.lines[1].closed);
  EXPECT_NEAR(cross.lines[0].length_m, 0.070, 0.002);
  EXPECT_NEAR(cross.lines[1].length_m, 0.060, 0.002);
  ASSERT_EQ(cross.junctions.size(), 1U);
  EXPECT_NEAR(cross.junctions[0].x_m, 0.0, 0.0005);
  EXPECT_EQ(cross.enclosed_areas, 0U);
}

TEST(ContourLines, TheEdgesOfAStrokeAreOneLineAndShapesBesideEachOtherStaySeparate) {
  // Each stroke is two bands 0.5 mm apart; the outer bands of the two squares are 1.5 mm apart.
  const auto rings = [](double x, double y, double middle) {
    const double out = std::max(std::abs(x - middle), std::abs(y));
    return (out > 14.0 && out < 15.0) || (out > 15.5 && out < 16.5);
  };
  const auto two = find_contour_lines(
      drawing([&](double x, double y) { return rings(x, y, -17.25) || rings(x, y, 17.25); }));
  ASSERT_EQ(two.lines.size(), 2U);
  for (const ContourLine& line : two.lines) {
    EXPECT_TRUE(line.closed);
    EXPECT_NEAR(line.length_m, 8 * 0.01525, 0.004);
  }
  EXPECT_TRUE(two.junctions.empty());
  EXPECT_EQ(two.enclosed_areas, 2U);
}

TEST(ContourLines, AGridHasFourLinesThatEncloseOneArea) {
  const auto grid = find_contour_lines(drawing([](double x, double y) {
    return std::max(std::abs(x), std::abs(y)) < 38 &&
           (std::abs(std::abs(x) - 20) < 0.6 || std::abs(std::abs(y) - 20) < 0.6);
  }));
  ASSERT_EQ(grid.lines.size(), 4U);
  for (const ContourLine& line : grid.lines) EXPECT_FALSE(line.closed);
  EXPECT_EQ(grid.junctions.size(), 4U);
  EXPECT_EQ(grid.enclosed_areas, 1U);
}

TEST(ContourLines, AClosedLineStaysClosedWhereAnotherCrossesIt) {
  const auto ring = find_contour_lines(drawing([](double x, double y) {
    return std::abs(std::hypot(x, y) - 25) < 0.6 || (std::abs(y - 5) < 0.6 && std::abs(x) < 40);
  }));
  ASSERT_EQ(ring.lines.size(), 2U);
  EXPECT_TRUE(ring.lines[0].closed);
  EXPECT_FALSE(ring.lines[1].closed);
  EXPECT_EQ(ring.junctions.size(), 2U);
}

TEST(ContourLines, DistanceIsToTheCentreLineNotToTheEdge) {
  // 4 mm wide, the strength falling from the middle to half.
  Raster<models::BoundaryPixel> edges(400, 400);
  for (int j = 0; j < 400; ++j)
    for (int i = 0; i < 400; ++i) {
      const double off_mm = std::abs(0.25 * (199.5 - j));
      if (off_mm < 2.0) edges(i, j) = {static_cast<float>(1.0 - 0.25 * off_mm), 0.0F};
    }
  const auto map = models::BoundaryMap::from_edges(std::move(edges), 0.00025, 2.0, {0.5, 0.01}, Work{});
  const auto near = nearest_line(*map, {0.0, 0.010}, 0.015);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->dy_m, -0.010, 0.0001);
}

TEST(ContourLines, NearestLineGivesOffsetAndOrientation) {
  const auto scene = circle_and_line();
  const auto below = nearest_line(boundaries(scene), {0.0, -0.025}, 0.01);
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->dx_m, 0.0, 0.0003);
  EXPECT_NEAR(below->dy_m, 0.005, 0.0001);
  EXPECT_NEAR(below->angle_rad, 0.0, 0.01);
  const auto left = nearest_line(boundaries(scene), {-0.0405, 0.02}, 0.01);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->angle_rad, 0.5 * std::numbers::pi, 0.05);
  EXPECT_FALSE(nearest_line(boundaries(scene), {0.03, 0.0}, 0.005));
}

}  // namespace
}  // namespace palpable::describe
