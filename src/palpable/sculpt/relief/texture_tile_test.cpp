// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/texture_tile.hpp"

#include "palpable/models/material/touch_texture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A grey picture of 128 x 128 with the values of a function on the unit square, x right, y down.
Image grey_of(const std::function<double(double, double)>& value) {
  Image image{128, 128, 1, 16, {}};
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      image.samples.push_back(static_cast<float>(value((x + 0.5) / 128.0, (y + 0.5) / 128.0)));
  return image;
}

double hills(double x, double y) {
  return std::sin(kTurn * 2 * x) * std::cos(kTurn * 3 * y) + 0.5 * std::sin(kTurn * (x + 2 * y));
}

/// The normal map of hills() times a height.
Image normals_of_hills() {
  constexpr double kStep = 1e-5, kHeight = 0.02;
  Image image{128, 128, 3, 16, {}};
  for (int j = 0; j < 128; ++j)
    for (int i = 0; i < 128; ++i) {
      const double x = (i + 0.5) / 128.0, y = (j + 0.5) / 128.0;
      const double dx = kHeight * (hills(x + kStep, y) - hills(x - kStep, y)) / (2 * kStep);
      const double up = -kHeight * (hills(x, y + kStep) - hills(x, y - kStep)) / (2 * kStep);
      const double length = std::sqrt(dx * dx + up * up + 1.0);
      for (const double n : {-dx / length, -up / length, 1.0 / length})
        image.samples.push_back(static_cast<float>(0.5 + 0.5 * n));
    }
  return image;
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    aa += static_cast<double>(a[i]) * static_cast<double>(a[i]);
    bb += static_cast<double>(b[i]) * static_cast<double>(b[i]);
  }
  return ab / std::sqrt(aa * bb);
}

TEST(TextureTile, OfANormalMapIsThatOfItsHeights) {
  const auto of_heights = texture_tile(grey_of([](double x, double y) { return 0.5 + 0.25 * hills(x, y); }));
  ASSERT_TRUE(is_normal_map(normals_of_hills()));
  const auto of_normals = texture_tile(normals_of_hills());
  ASSERT_TRUE(of_heights);
  ASSERT_TRUE(of_normals);
  EXPECT_GE(correlation(*of_heights, *of_normals), 0.999);
}

TEST(TextureTile, IsHighWhereThePictureIsWhiteWithItsUpUpwards) {
  // One bright spot in the upper right quarter.
  auto tile = texture_tile(grey_of(
      [](double x, double y) { return std::exp(-50.0 * (std::pow(x - 0.75, 2) + std::pow(y - 0.25, 2))); }));
  ASSERT_TRUE(tile);
  models::TouchTexture texture{models::TouchTexture::Kind::picture, 0.001, 30e-6, 0.0, *tile};
  ASSERT_TRUE(models::is_valid(texture));
  const models::TexturePattern pattern(texture);
  const double side = models::kPictureForms * 0.001;
  double highest = -1.0, at_x = 0.0, at_y = 0.0;
  for (double x = 0.0; x < side; x += side / 100)
    for (double y = 0.0; y < side; y += side / 100)
      if (const double h = pattern.sample(x, y).z_m; h > highest) highest = h, at_x = x, at_y = y;
  EXPECT_NEAR(at_x / side, 0.75, 0.02);
  EXPECT_NEAR(at_y / side, 0.75, 0.02);
}

TEST(TextureTile, HasNoHigherFrequencyOrCurvatureThanItsPitchAllows) {
  // Stripes of one pixel and random squares: all of it too fine, or with sharp edges.
  const auto tile = texture_tile(grey_of([](double x, double y) {
    const int i = static_cast<int>(x * 128), j = static_cast<int>(y * 128);
    return (i % 2 == 0 ? 0.3 : 0.0) + ((i / 24 + j / 24) % 2 == 0 ? 0.5 : 0.0);
  }));
  ASSERT_TRUE(tile);
  const double pitch = 0.002, height = 20e-6;
  const models::TexturePattern pattern({models::TouchTexture::Kind::picture, pitch, height, 0.0, *tile});
  const double step = pitch / 50.0;
  double bend = 0.0;
  for (double y = 0.0; y < 12 * pitch; y += pitch / 3.0)
    for (double x = 0.0; x < 12 * pitch; x += step)
      bend = std::max(bend, std::abs(pattern.sample(x + step, y).dzdx - pattern.sample(x, y).dzdx) / step);
  EXPECT_LE(bend, 1.001 * height * std::pow(kTurn / pitch, 2));
  EXPECT_GE(bend, 0.1 * height * std::pow(kTurn / pitch, 2));
}

TEST(TextureTile, IsRefusedForPicturesOfOneToneAndInvalidOnes) {
  EXPECT_FALSE(texture_tile(grey_of([](double, double) { return 0.4; })));
  EXPECT_FALSE(texture_tile(Image{4, 4, 1, 8, std::vector<float>(16, 0.1F)}));
  Image broken = grey_of(hills);
  broken.samples[7] = std::nanf("");
  EXPECT_FALSE(texture_tile(broken));
}

}  // namespace
}  // namespace palpable::sculpt
