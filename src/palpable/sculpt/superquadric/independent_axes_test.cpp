// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/independent_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

std::array<Vec3, 3> random_axes(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto direction = [&] { return unit(Vec3{normal(random), normal(random), normal(random)}); };
  const Vec3 x = direction();
  const Vec3 y = unit(cross(x, direction()));
  return {x, y, cross(x, y)};
}

/// Points on the surface of a box with half sides 1, 1, `height`.
std::vector<Vec3> on_box(double height, const std::array<Vec3, 3>& axes, Vec3 centre, std::mt19937& random) {
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < 3000; ++k) {
    std::array p{side(random), side(random), side(random)};
    p[k % 3] = k % 2 == 0 ? -1.0 : 1.0;
    points.push_back(centre + p[0] * axes[0] + p[1] * axes[1] + height * p[2] * axes[2]);
  }
  return points;
}

TEST(IndependentAxes, AreThoseOfBoxesWithEqualSides) {
  std::mt19937 random(7);
  const Vec3 centre{0.3, -0.2, 1.0};
  for (int k = 0; k < 20; ++k) {
    const std::array<Vec3, 3> of_box = random_axes(random);
    const auto found = independent_axes(on_box(k % 2 == 0 ? 1.0 : 0.2, of_box, centre, random), centre);
    EXPECT_NEAR(dot(cross(found[0], found[1]), found[2]), 1.0, 1e-9);
    for (const Vec3 axis : found) {
      double nearest = 0.0;
      for (const Vec3 true_axis : of_box) nearest = std::max(nearest, std::abs(dot(axis, true_axis)));
      EXPECT_GT(nearest, 0.995) << "box " << k;
    }
  }
}

TEST(IndependentAxes, OfFlatPointsAndOfABallAreOrthonormal) {
  std::mt19937 random(7);
  std::vector<Vec3> flat, ball;
  for (int k = 0; k < 500; ++k) {
    const std::array<Vec3, 3> axes = random_axes(random);
    ball.push_back(axes[0]);
    flat.push_back({axes[1].x, axes[1].y, 0.0});
  }
  for (const auto& points : {flat, ball}) {
    const auto axes = independent_axes(points, {});
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(dot(axes[a], axes[b]), a == b ? 1.0 : 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace palpable::sculpt
