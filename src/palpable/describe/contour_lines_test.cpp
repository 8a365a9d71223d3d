// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/contour_lines.hpp"

#include "palpable/describe/test_scenes.hpp"

#include <numbers>

namespace palpable::describe {
namespace {

const models::BoundaryMap& boundaries(const models::Scene& scene) {
  return std::get<std::shared_ptr<const models::Contours>>(scene.model)->boundaries;
}

TEST(ContourLines, AreCountedWithLengthPlaceAndWhetherTheyAreClosed) {
  const auto scene = circle_and_line();
  const auto lines = find_contour_lines(boundaries(scene));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_NEAR(lines[0].length_m, 2.0 * std::numbers::pi * 0.02, 0.012);
  EXPECT_NEAR(lines[0].middle().x_m, -0.02, 0.001);
  EXPECT_NEAR(lines[0].middle().y_m, 0.02, 0.001);
  EXPECT_NEAR(lines[0].most.x_m - lines[0].least.x_m, 0.04, 0.001);
  EXPECT_FALSE(lines[1].closed);
  EXPECT_NEAR(lines[1].length_m, 0.06, 0.002);
  EXPECT_NEAR(lines[1].middle().y_m, -0.02, 0.001);
}

TEST(ContourLines, KeepAnInnerLineOpenInsideAClosedOne) {
  constexpr int kSide = 100;
  Raster<models::BoundaryPixel> edges(kSide, kSide);
  for (int i = 10; i < 90; ++i) edges(i, 10) = edges(i, 89) = edges(10, i) = edges(89, i) = {1.0F, 0.0F};
  for (int i = 30; i < 70; ++i) edges(i, 50) = {1.0F, 0.0F};
  const auto map = models::BoundaryMap::from_edges(std::move(edges), 0.001, 2.0, {0.5, 0.01}, Work{});
  ASSERT_TRUE(map);
  const auto lines = find_contour_lines(*map);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_FALSE(lines[1].closed);
}

TEST(ContourLines, TheNearestHasADistanceAndADirection) {
  const auto scene = circle_and_line();
  const auto below = nearest_line(boundaries(scene), {0.0, -0.025}, 0.01);
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->dx_m, 0.0, 0.0003);
  EXPECT_NEAR(below->dy_m, 0.0046, 0.0005);
  EXPECT_NEAR(below->angle_rad, 0.0, 0.01);
  const auto left = nearest_line(boundaries(scene), {-0.0405, 0.02}, 0.01);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->angle_rad, 0.5 * std::numbers::pi, 0.05);
  EXPECT_FALSE(nearest_line(boundaries(scene), {0.03, 0.0}, 0.005));
}

}  // namespace
}  // namespace palpable::describe
