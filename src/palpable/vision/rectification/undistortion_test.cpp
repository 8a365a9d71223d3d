// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/undistortion.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 200, kHeight = 160;
const LensCamera kLens{{150, 0, 99.5, 0, 150, 79.5, 0, 0, 1}, {-0.2, 0.03, 0, 0}};

// White within `radius` of the centre, as a lens with radial distortion shows it.
Raster<Rgb8> disc(double radius, bool distorted) {
  Raster<Rgb8> out(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double r = std::hypot(x - 99.5, y - 79.5);
      const double u = radius / 150;
      const double edge = distorted ? radius * (1 - 0.2 * u * u + 0.03 * u * u * u * u) : radius;
      const std::uint8_t level = r < edge ? 255 : 0;
      out(x, y) = {level, level, level};
    }
  return out;
}

TEST(Undistortion, GivesEveryRadiusBack) {
  for (const double radius : {20.0, 45.0, 70.0}) {
    Raster<Rgb8> picture = disc(radius, true);
    const std::array<Raster<Rgb8>*, 1> pictures{&picture};
    ASSERT_TRUE(undistort(pictures, kLens, {}));
    const Raster<Rgb8> truth = disc(radius, false);
    int wrong = 0, white = 0;
    for (std::size_t i = 0; i < truth.count(); ++i) {
      wrong += (truth.values()[i].r > 127) != (picture.values()[i].r > 127) ? 1 : 0;
      white += truth.values()[i].r > 127 ? 1 : 0;
    }
    EXPECT_LT(wrong, 4 * radius) << "more than the edge, of " << white;
  }
}

TEST(Undistortion, RefusesPicturesOfDifferentSizes) {
  Raster<Rgb8> a(8, 8), b(8, 9);
  const std::array<Raster<Rgb8>*, 2> pictures{&a, &b};
  const auto done = undistort(pictures, kLens, {});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace palpable::vision
