// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/chessboard_calibration.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr double kFocal_px = 500.0, kCx = 322.0, kCy = 238.0;

/// A board of 10 x 7 squares of 25 mm, turned about x and y and 0.45 m away, as a pinhole camera at
/// (eye_m, 0, 0) sees it; 3 x 3 samples a pixel.
Image board(double about_x, double about_y, double eye_m) {
  const double cx = std::cos(about_x), sx = std::sin(about_x), cy = std::cos(about_y), sy = std::sin(about_y);
  // The board's axes and normal in the camera's frame.
  const Vec3 u{cy, 0.0, -sy}, v{sx * sy, cx, sx * cy}, n = cross(u, v), middle{-eye_m, 0.0, 0.45};
  Image image{640, 480, 1, 8, {}};
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      double sum = 0.0;
      for (int k = 0; k < 9; ++k) {
        const Vec3 ray{(x + (k % 3 - 1) / 3.0 - kCx) / kFocal_px, (y + (k / 3 - 1) / 3.0 - kCy) / kFocal_px,
                       1.0};
        const Vec3 p = (dot(middle, n) / dot(ray, n)) * ray - middle;
        const double a = dot(p, u) / 0.025 + 5.0, b = dot(p, v) / 0.025 + 3.5;
        const bool inside = a > 0.0 && a < 10.0 && b > 0.0 && b < 7.0;
        const bool black = inside && (static_cast<int>(a) + static_cast<int>(b)) % 2 == 0;
        sum += black ? 0.1 : 0.9;
      }
      image.samples.push_back(static_cast<float>(sum / 9.0));
    }
  return image;
}

constexpr std::array<std::array<double, 2>, 5> kTilts{
    {{0.4, 0.0}, {-0.4, 0.1}, {0.1, 0.45}, {0.0, -0.45}, {0.3, 0.3}}};

TEST(Chessboards, CalibrateACamera) {
  std::vector<Image> pictures;
  for (const auto& tilt : kTilts) pictures.push_back(board(tilt[0], tilt[1], 0.0));
  const auto found = calibrate_camera(pictures, {}, {});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_EQ(found->pictures_used, 5);
  // Nine samples per pixel locate an edge to a third of a pixel.
  EXPECT_LT(found->reprojection_px, 0.2);
  EXPECT_NEAR(found->camera.matrix[0], kFocal_px, 3.0);
  EXPECT_NEAR(found->camera.matrix[2], kCx, 2.0);
  EXPECT_NEAR(found->camera.matrix[5], kCy, 2.0);
}

TEST(Chessboards, CalibrateThePoseOfTwoCameras) {
  std::vector<StereoPair> pairs;
  for (const auto& tilt : kTilts)
    pairs.push_back({board(tilt[0], tilt[1], 0.0), board(tilt[0], tilt[1], 0.06), {}});
  const auto found = calibrate_from_chessboards(pairs, {}, {});
  ASSERT_TRUE(found) << found.error().sentence();
  // p_right = p_left + T: a camera 60 mm to the right.
  EXPECT_NEAR(found->cameras.translation_m.x, -0.06, 0.0005);
  EXPECT_NEAR(found->cameras.translation_m.y, 0.0, 0.0005);
  EXPECT_NEAR(found->cameras.rotation[0], 1.0, 1e-4);
}

TEST(Chessboards, MustBeVisibleInEnoughPictures) {
  const std::vector<Image> two{board(0.4, 0.0, 0.0), board(-0.4, 0.1, 0.0)};
  EXPECT_FALSE(calibrate_camera(two, {}, {}));
  EXPECT_FALSE(calibrate_camera(two, {1, 6}, {}));
}

}  // namespace
}  // namespace palpable::vision
