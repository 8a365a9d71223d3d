// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/contours/grooves.hpp"

#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// A map of 100 x 80 px, 0.5 mm each, with a boundary down the column x = 50.
models::BoundaryMap upright_line() {
  Raster<models::BoundaryPixel> edges(100, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 48; x <= 52; ++x) edges(x, y) = {-0.9F / static_cast<float>(1 + std::abs(x - 50)), 0.0F};
  auto map = models::BoundaryMap::from_edges(std::move(edges), 0.0005, 3.0, {0.5, 0.01}, Work{});
  EXPECT_TRUE(map);
  return std::move(*map);
}

TEST(BoundaryLines, AreOnePixelWideAndWhereTheRidgeIs) {
  const Raster<float> lines = boundary_lines(upright_line());
  for (int y = 1; y < 79; ++y)
    for (int x = 0; x < 100; ++x) EXPECT_EQ(lines(x, y) > 0.0F, x == 50) << x << " " << y;
}

TEST(Grooves, LieAlongTheLineWithTheGivenWidthAndDepth) {
  const auto relief = grooves_from_boundary_map(upright_line(), {0.004, 0.0015});
  ASSERT_TRUE(relief);
  const double line_x = (50 - 49.5) * 0.0005;
  EXPECT_LT(relief->sample(line_x, 0.0).z_m, 0.0002);
  EXPECT_NEAR(relief->sample(line_x + 0.001, 0.0).z_m, 0.00075, 0.0002);
  EXPECT_NEAR(relief->sample(line_x + 0.003, 0.0).z_m, 0.0015, 1e-5);
  EXPECT_NEAR(relief->sample(line_x - 0.003, 0.01).z_m, 0.0015, 1e-5);
  EXPECT_NEAR(relief->size_x_m(), 0.05, 1e-6);
}

TEST(Grooves, PushTheHandTowardsTheLine) {
  const auto relief = grooves_from_boundary_map(upright_line(), {});
  ASSERT_TRUE(relief);
  EXPECT_GT(relief->sample(0.00025 + 0.001, 0.0).dzdx, 0.1);
  EXPECT_LT(relief->sample(0.00025 - 0.001, 0.0).dzdx, -0.1);
}

TEST(Grooves, RefuseSizesThatNoHandCouldFollow) {
  EXPECT_FALSE(grooves_from_boundary_map(upright_line(), {0.1, 0.001}));
  EXPECT_FALSE(grooves_from_boundary_map(upright_line(), {0.004, 0.0}));
}

}  // namespace
}  // namespace palpable::sculpt
