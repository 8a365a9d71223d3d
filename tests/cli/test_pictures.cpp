// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "test_pictures.hpp"

#include "palpable/formats/picture/picture.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace palpable::test {
namespace {

/// Three octaves of value noise, 0…1. Deterministic.
double noise(double x, double y, unsigned seed) {
  const auto at = [seed](long i, long j) {
    std::uint32_t h = static_cast<std::uint32_t>(i) * 374761393U +
                      static_cast<std::uint32_t>(j) * 668265263U + seed * 2246822519U;
    h = (h ^ (h >> 13U)) * 1274126177U;
    return static_cast<double>((h ^ (h >> 16U)) & 0xFFFFU) / 65535.0;
  };
  const double fx = std::floor(x), fy = std::floor(y);
  const auto i = static_cast<long>(fx), j = static_cast<long>(fy);
  const double u = x - fx, v = y - fy;
  return (1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) +
         v * ((1 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
}

Rgb8 texture(double x, double y, unsigned seed) {
  const double value = 0.5 * noise(0.5 * x, 0.5 * y, seed) + 0.3 * noise(x, y, seed + 1) +
                       0.2 * noise(0.1 * x, 0.1 * y, seed + 2);
  const double tone = noise(0.07 * x, 0.07 * y, seed + 3);
  const auto to8 = [](double v) { return static_cast<std::uint8_t>(std::lround(255.0 * v)); };
  return {to8(value), to8(0.7 * value + 0.3 * tone), to8(0.8 * value + 0.2 * (1.0 - tone))};
}

bool in_box(double x, int y, int width, int height) {
  return x > 0.35 * width && x < 0.65 * width && y > height / 4 && y < (7 * height) / 10;
}

}  // namespace

Pair textured_pair(int width, int height, double floor_rise_px) {
  Pair pair{Raster<Rgb8>(width, height), Raster<Rgb8>(width, height), Raster<float>(width, height)};
  const auto background = [&](int y) {
    return y < height / 2 ? 3.0 : 3.0 + 2.0 * floor_rise_px * (y - height / 2) / height;
  };
  constexpr double kBox = 12.0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool box = in_box(x, y, width, height);
      const double d = box ? kBox : background(y);
      pair.disparity_px(x, y) = static_cast<float>(d);
      pair.left(x, y) = texture(x, y, box ? 7U : 1U);
      // The right picture shows the left one's pixel at x + d; the box occludes the background.
      const bool box_here = in_box(x + kBox, y, width, height);
      pair.right(x, y) = texture(x + (box_here ? kBox : background(y)), y, box_here ? 7U : 1U);
    }
  }
  return pair;
}

Raster<Rgb8> unrelated_picture(int width, int height, unsigned seed) {
  Raster<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(x, y) = texture(x, y, seed);
  return picture;
}

void write_pair(const std::string& folder, const Pair& pair) {
  ASSERT_TRUE(formats::write_png(folder + "/left.png", pair.left));
  ASSERT_TRUE(formats::write_png(folder + "/right.png", pair.right));
  ASSERT_TRUE(formats::write_disparity_pfm(folder + "/truth.pfm", pair.disparity_px));
}

}  // namespace palpable::test
