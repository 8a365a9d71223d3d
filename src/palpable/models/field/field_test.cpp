// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/field.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

TEST(Field, HasNoStepsOnASlopeSeenFromAbove) {
  const Lattice lattice{{-0.02, -0.02, -0.02}, 0.001, {41, 41, 41}};
  const Vec3 normal = unit(Vec3{0.2, -0.1, 1.0});
  std::vector<float> values;
  for (int z = 0; z < lattice.counts[2]; ++z)
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int x = 0; x < lattice.counts[0]; ++x)
        values.push_back(static_cast<float>(dot(normal, lattice.place_m(x, y, z))));
  auto distance = DenseField::from(lattice, DenseContent::distance, std::move(values), {});
  ASSERT_TRUE(distance);
  const auto field = field_of(*std::move(distance), {-0.015, -0.015, -0.01}, {0.015, 0.015, 0.01});
  ASSERT_TRUE(field);
  for (double y = -0.012; y <= 0.012; y += 0.0007)
    for (double x = -0.012; x <= 0.012; x += 0.0007)
      ASSERT_NEAR(field->from_above->sample(x, y).z_m, -(normal.x * x + normal.y * y) / normal.z, 1e-6);
}

}  // namespace
}  // namespace palpable::models
