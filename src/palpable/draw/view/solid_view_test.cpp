// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/solid_view.hpp"

#include "palpable/draw/canvas/test_pixels.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::draw {
namespace {

/// A ball of radius 10 mm about the origin, as a dense field.
std::shared_ptr<const models::FieldOnLattice> ball() {
  const models::Lattice lattice{{-0.015, -0.015, -0.015}, 0.0005, {61, 61, 61}};
  std::vector<float> values;
  for (int z = 0; z < 61; ++z)
    for (int y = 0; y < 61; ++y)
      for (int x = 0; x < 61; ++x)
        values.push_back(static_cast<float>(norm(lattice.place_m(x, y, z)) - 0.01));
  auto distance = models::DenseField::from(lattice, models::DenseContent::distance, std::move(values), {});
  auto field = models::field_of(std::move(*distance), {-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01});
  return std::make_shared<const models::FieldOnLattice>(std::move(*field));
}

TEST(SolidFigure, IsLitFromTheUpperLeftOnAnEmptyBackground) {
  const Figure figure = solid_figure(ball(), {}, {});
  // The ball is in the plot's middle; its radius follows from the box's diagonal.
  const double middle_x = 40.0 + 450.0, middle_y = 100.0 + 350.0, radius = 350.0 / std::sqrt(3.0);
  const double upper_left = luma(colour_at(figure, {middle_x - 0.5 * radius, middle_y - 0.5 * radius}));
  const double lower_right = luma(colour_at(figure, {middle_x + 0.5 * radius, middle_y + 0.5 * radius}));
  EXPECT_GT(upper_left, lower_right + 40.0);
  EXPECT_GT(luma(colour_at(figure, {middle_x, 110.0})), 245.0);
}

}  // namespace
}  // namespace palpable::draw
