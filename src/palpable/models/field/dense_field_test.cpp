// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/dense_field.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

const Lattice kLattice{{-0.01, 0.002, -0.004}, 0.001, {12, 9, 7}};

/// A function that trilinear interpolation reproduces exactly.
double trilinear(Vec3 p) {
  return 0.003 + 0.4 * p.x - 0.7 * p.y + 0.6 * p.z + 20.0 * p.x * p.y - 3000.0 * p.x * p.y * p.z;
}
Vec3 slope(Vec3 p) {
  return {0.4 + 20.0 * p.y - 3000.0 * p.y * p.z, -0.7 + 20.0 * p.x - 3000.0 * p.x * p.z,
          0.6 - 3000.0 * p.x * p.y};
}

std::vector<float> values_of(const Lattice& lattice, DenseContent content) {
  std::vector<float> values;
  for (int z = 0; z < lattice.counts[2]; ++z)
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int x = 0; x < lattice.counts[0]; ++x) {
        const Vec3 p = lattice.place_m(x, y, z);
        values.push_back(static_cast<float>(trilinear(p)));
        if (content == DenseContent::distance_and_force)
          for (const double f : {p.x, p.y, p.z}) values.push_back(static_cast<float>(f));
      }
  return values;
}

DenseField field_with(DenseContent content) {
  auto field = DenseField::from(kLattice, content, values_of(kLattice, content), {});
  EXPECT_TRUE(field);
  return *std::move(field);
}

TEST(DenseField, InterpolatesDistanceAndItsExactDerivative) {
  const DenseField field = field_with(DenseContent::distance);
  EXPECT_EQ(field.memory_bytes(), sizeof(DenseField) + 4 * kLattice.places());
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 size = kLattice.size_m();
    const Vec3 p = kLattice.origin_m +
                   Vec3{uniform(random) * size.x, uniform(random) * size.y, uniform(random) * size.z};
    const FieldSample s = field.sample({p});
    ASSERT_NEAR(s.distance_m, trilinear(p), 2e-9);
    ASSERT_NEAR(norm(s.gradient.v - slope(p)), 0.0, 5e-6);
  }
}

TEST(DenseField, InterpolatesTheForceThatIsStoredBesideTheDistance) {
  const DenseField field = field_with(DenseContent::distance_and_force);
  EXPECT_EQ(field.memory_bytes(), sizeof(DenseField) + 16 * kLattice.places());
  const Vec3 p{-0.0043, 0.0061, -0.0012};
  const FieldSample s = field.sample({p});
  EXPECT_NEAR(s.distance_m, trilinear(p), 2e-9);
  EXPECT_NEAR(norm(s.gradient.v - p), 0.0, 1e-9);
}

TEST(DenseField, AddsTheDistanceToItsBoxOutside) {
  const DenseField field = field_with(DenseContent::distance);
  const Vec3 corner = kLattice.origin_m + kLattice.size_m();
  EXPECT_TRUE(field.contains({corner}));
  EXPECT_FALSE(field.contains({corner + Vec3{1e-6, 0.0, 0.0}}));
  const FieldSample s = field.sample({corner + Vec3{0.0, 0.5, 0.0}});
  EXPECT_NEAR(s.distance_m, trilinear(corner) + 0.5, 1e-8);
  EXPECT_EQ(s.gradient.v, (Vec3{0.0, 1.0, 0.0}));
}

TEST(DenseField, RefusesInconsistentInput) {
  const auto values = values_of(kLattice, DenseContent::distance);
  EXPECT_FALSE(DenseField::from(kLattice, DenseContent::distance_and_force, values, {}));
  Lattice flat = kLattice;
  flat.counts[1] = 1;
  EXPECT_FALSE(DenseField::from(flat, DenseContent::distance, values, {}));
  auto broken = values;
  broken[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(DenseField::from(kLattice, DenseContent::distance, broken, {}));
}

}  // namespace
}  // namespace palpable::models
