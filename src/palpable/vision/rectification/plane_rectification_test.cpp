// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/plane_rectification.hpp"

#include "palpable/vision/stereo/problem/rectifying_transform.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kMapWidth = 640, kMapHeight = 480;
constexpr double kFocal = 560.0;

/// The projection of a point on a table (metres) by a camera that looks down on it at an angle.
PicturePoint seen(double x, double y) {
  const double pitch = 0.6, yaw = 0.25;
  const double u = std::cos(yaw) * x - std::sin(yaw) * y, v = std::sin(yaw) * x + std::cos(yaw) * y;
  const double depth = 2.0 + std::sin(pitch) * v, down = -std::cos(pitch) * v;
  return {0.5 * (kMapWidth - 1) + kFocal * u / depth, 0.5 * (kMapHeight - 1) + kFocal * down / depth};
}

PictureLine line(double x1, double y1, double x2, double y2) { return {seen(x1, y1), seen(x2, y2)}; }

/// Checks that distances on the rectified table have the table's proportions.
void expect_metric(const RectifiedPlane& plane, double tolerance) {
  const auto distance = [&](double x1, double y1, double x2, double y2) {
    const PicturePoint a = mapped(plane.picture_from_input, seen(x1, y1)),
                       b = mapped(plane.picture_from_input, seen(x2, y2));
    return std::hypot(a.x - b.x, a.y - b.y) / std::hypot(x1 - x2, y1 - y2);
  };
  const double across = distance(-0.4, 0.1, 0.5, 0.1);
  EXPECT_NEAR(distance(0.2, -0.3, 0.2, 0.4) / across, 1.0, tolerance);
  EXPECT_NEAR(distance(-0.3, -0.2, 0.3, 0.4) / across, 1.0, tolerance);
  EXPECT_NEAR(distance(-0.3, 0.4, 0.3, -0.2) / across, 1.0, tolerance);
}

Image grey_picture() {
  return {kMapWidth, kMapHeight, 1, 8, std::vector<float>(kMapWidth * kMapHeight, 0.5F)};
}

PlaneLines table_lines() {
  PlaneLines lines;
  lines.along = {line(-0.5, -0.3, 0.5, -0.3), line(-0.5, 0.4, 0.5, 0.4)};
  lines.across = {line(-0.4, -0.3, -0.4, 0.4), line(0.4, -0.3, 0.4, 0.4)};
  return lines;
}

TEST(RectifyPlane, RestoresProportionsFromTwoOrthogonalPairs) {
  PlaneLines lines = table_lines();
  lines.orthogonal = {{line(0, 0, 0.3, 0), line(0, 0, 0, 0.3)},
                      {line(0, 0, 0.3, 0.3), line(0, 0, 0.3, -0.3)}};
  const auto plane = rectify_plane(grey_picture(), lines);
  ASSERT_TRUE(plane) << plane.error().sentence();
  expect_metric(*plane, 1e-6);
  // The `along` lines become horizontal, and nothing is mirrored.
  const PicturePoint a = mapped(plane->picture_from_input, seen(-0.4, 0.1)),
                     b = mapped(plane->picture_from_input, seen(0.4, 0.1)),
                     above = mapped(plane->picture_from_input, seen(-0.4, 0.3));
  EXPECT_NEAR(a.y, b.y, 1e-6);
  EXPECT_GT(b.x, a.x);
  EXPECT_LT(above.y, a.y);
}

TEST(RectifyPlane, RestoresProportionsFromThePerspectiveAlone) {
  const auto plane = rectify_plane(grey_picture(), table_lines());
  ASSERT_TRUE(plane) << plane.error().sentence();
  EXPECT_TRUE(plane->notes.empty());
  expect_metric(*plane, 1e-6);
}

TEST(RectifyPlane, RefusesLinesThatDetermineNoPlane) {
  PlaneLines lines = table_lines();
  lines.across = lines.along;
  EXPECT_FALSE(rectify_plane(grey_picture(), lines));
  // The same right angle, given twice.
  lines = table_lines();
  lines.orthogonal = {{line(0, 0, 0.3, 0), line(0, 0, 0, 0.3)},
                      {line(0, 0.1, 0.3, 0.1), line(0.1, 0, 0.1, 0.3)}};
  EXPECT_FALSE(rectify_plane(grey_picture(), lines));
}

TEST(RectifyRectangle, CropsARectangleInItsProportions) {
  PlaneRectangle rectangle{{seen(-0.45, 0.3), seen(0.45, 0.3), seen(0.45, -0.3), seen(-0.45, -0.3)}, {}};
  for (const bool stated : {false, true}) {
    if (stated) rectangle.aspect = 1.5;
    const auto plane = rectify_rectangle(grey_picture(), rectangle);
    ASSERT_TRUE(plane) << plane.error().sentence();
    EXPECT_NEAR(1.0 * plane->picture.width / plane->picture.height, 1.5, 0.01) << stated;
    expect_metric(*plane, 0.001);
  }
  std::swap(rectangle.corners[0], rectangle.corners[1]);
  EXPECT_FALSE(rectify_rectangle(grey_picture(), rectangle));
}

/// The camera's picture of a table with a grid of streets.
Image photographed_map() {
  Image picture = grey_picture();
  for (int y = 0; y < kMapHeight; ++y)
    for (int x = 0; x < kMapWidth; ++x) {
      // The point of the table at a pixel: the inverse of seen().
      const double pitch = 0.6, yaw = 0.25, i = (x - 0.5 * (kMapWidth - 1)) / kFocal,
                   j = (y - 0.5 * (kMapHeight - 1)) / kFocal;
      const double v = -2.0 * j / (std::cos(pitch) + j * std::sin(pitch)),
                   u = i * (2.0 + std::sin(pitch) * v);
      const double tx = std::cos(yaw) * u + std::sin(yaw) * v, ty = -std::sin(yaw) * u + std::cos(yaw) * v;
      const bool inside = std::abs(tx) < 0.6 && std::abs(ty) < 0.45;
      const auto on_street = [](double t) { return std::abs(t - 0.15 * std::round(t / 0.15)) < 0.02; };
      picture.samples[static_cast<std::size_t>(y * kMapWidth + x)] = !inside                          ? 0.25F
                                                                     : on_street(tx) || on_street(ty) ? 0.95F
                                                                                                      : 0.6F;
    }
  return picture;
}

TEST(PlaneTilt, IsFoundByTheRightAnglesOfAPhotographedMap) {
  const Image picture = photographed_map();
  const auto tilt = find_plane_tilt(picture, Work{});
  ASSERT_TRUE(tilt && *tilt);
  const auto plane = rectify_tilt(picture, **tilt);
  ASSERT_TRUE(plane);
  expect_metric(*plane, 0.03);
  // What was straightened is straight.
  const auto again = find_plane_tilt(plane->picture, Work{});
  ASSERT_TRUE(again);
  EXPECT_FALSE(*again);
}

TEST(PlaneTilt, IsNotFoundInAPlainPicture) {
  const auto tilt = find_plane_tilt(grey_picture(), Work{});
  ASSERT_TRUE(tilt);
  EXPECT_FALSE(*tilt);
}

}  // namespace
}  // namespace palpable::vision
