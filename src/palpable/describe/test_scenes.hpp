// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/scene/scene.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::describe {

/// A scene of 100 x 75 mm whose height in metres at (x, y) is `height(x, y)`.
template <class Height>
models::Scene surface_scene(const Height& height) {
  constexpr int kColumns = 200, kRows = 150;
  constexpr double kPixel_m = 0.0005;
  Raster<float> heights(kColumns, kRows);
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i)
      heights(i, j) = static_cast<float>(
          height((i + 0.5 - 0.5 * kColumns) * kPixel_m, (0.5 * kRows - j - 0.5) * kPixel_m));
  models::Scene scene;
  scene.model =
      std::make_shared<const models::Relief>(*models::Relief::from_samples(std::move(heights), kPixel_m));
  scene.source.inputs = {"/somewhere/twin.png"};
  return scene;
}

inline double bump(double x, double y, double at_x, double at_y, double height) {
  const double r = std::hypot(x - at_x, y - at_y) / 0.008;
  return height * std::exp(-r * r);
}

/// Two rounded hills of 12 and 8 mm on a base of 1 mm.
inline models::Scene two_hills() {
  return surface_scene([](double x, double y) {
    return 0.001 + bump(x, y, -0.03, 0.02, 0.012) + bump(x, y, 0.025, -0.015, 0.008);
  });
}

/// The same with names: a table, a tall hill and a low one, each with a radius of 12 mm.
inline models::Scene named_hills() {
  models::Scene scene = two_hills();
  scene.materials.resize(3);
  scene.materials[0].name = "table";
  scene.materials[1].name = "tall hill";
  scene.materials[2].name = "low hill";
  scene.labels = Raster<std::uint8_t>(200, 150, 0);
  for (int j = 0; j < 150; ++j)
    for (int i = 0; i < 200; ++i) {
      const double x = (i - 99.5) * 0.0005, y = (74.5 - j) * 0.0005;
      if (std::hypot(x + 0.03, y - 0.02) < 0.012) scene.labels(i, j) = 1;
      if (std::hypot(x - 0.025, y + 0.015) < 0.012) scene.labels(i, j) = 2;
    }
  return scene;
}

/// Contours of 100 x 100 mm: a circle of 20 mm radius at the upper left, a line of 60 mm from left to right
/// 20 mm below the middle, and a speck.
inline models::Scene circle_and_line() {
  constexpr int kSide = 400;
  constexpr double kPixel_m = 0.00025;
  Raster<models::BoundaryPixel> edges(kSide, kSide);
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const double x = (i - 199.5) * kPixel_m, y = (199.5 - j) * kPixel_m;
      const double dx = x + 0.02, dy = y - 0.02;
      const double angle = std::atan2(dy, dx);
      if (std::abs(std::hypot(dx, dy) - 0.02) < 0.0005)
        edges(i, j) = {static_cast<float>(-std::cos(2.0 * angle)),
                       static_cast<float>(-std::sin(2.0 * angle))};
      if (std::abs(y + 0.02) < 0.0005 && std::abs(x) < 0.03) edges(i, j) = {1.0F, 0.0F};
      if (std::hypot(x - 0.04, y - 0.04) < 0.0005) edges(i, j) = {1.0F, 0.0F};
    }
  auto map = models::BoundaryMap::from_edges(std::move(edges), kPixel_m, 2.0, {0.5, 0.01}, Work{});
  models::Scene scene;
  scene.model = std::make_shared<const models::Contours>(
      models::Contours{*std::move(map), std::make_shared<const models::Relief>(*models::Relief::from_samples(
                                            Raster<float>(100, 100, 0.001F), 0.001))});
  scene.title = "Circle and line";
  return scene;
}

}  // namespace palpable::describe
