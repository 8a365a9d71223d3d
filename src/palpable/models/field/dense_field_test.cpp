// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/dense_field.hpp"

#include "palpable/models/field/outside_box.hpp"

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

TEST(DenseField, ContainsItsBox) {
  const DenseField field = field_with(DenseContent::distance);
  const Vec3 corner = kLattice.origin_m + kLattice.size_m();
  EXPECT_TRUE(field.contains({corner}));
  EXPECT_FALSE(field.contains({corner + Vec3{1e-6, 0.0, 0.0}}));
}

/// A ball of 6 mm in a box that surrounds it by 1 mm.
DenseField ball_in_a_box() {
  Lattice lattice{{-0.007, -0.007, -0.007}, 0.00025, {57, 57, 57}};
  std::vector<float> values(lattice.places());
  for (int z = 0; z < lattice.counts[2]; ++z)
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int x = 0; x < lattice.counts[0]; ++x)
        values[lattice.index(x, y, z)] = static_cast<float>(norm(lattice.place_m(x, y, z)) - 0.006);
  return *DenseField::from(lattice, DenseContent::distance, std::move(values), {});
}

TEST(DenseField, GivesTheDistanceOutsideItsBoxToo) {
  const DenseField field = ball_in_a_box();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit_range(-1.0, 1.0);
  double worst = 0.0, worst_turn = 0.0;
  int outside = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 p = 0.012 * Vec3{unit_range(random), unit_range(random), unit_range(random)};
    if (field.contains({p})) continue;
    ++outside;
    const double distance_m = norm(p) - 0.006;
    const FieldSample s = field.sample({p});
    EXPECT_GE(s.distance_m, distance_m - 5e-6);
    EXPECT_LE(least_outside_box(p - field.origin_m(), field.size_m(), s.distance_m), distance_m + 5e-6);
    worst = std::max(worst, (s.distance_m - distance_m) / distance_m);
    worst_turn = std::max(worst_turn, norm(s.gradient.v - unit(p)));
  }
  EXPECT_GT(outside, 10000);
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(worst_turn, 0.1);
}

TEST(DenseField, IsContinuousWhereItsBoxEnds) {
  const DenseField field = ball_in_a_box();
  for (const double x : {-0.005, 0.0, 0.0031, 0.0069})
    for (const double y : {-0.006, 0.001, 0.0045}) {
      const FieldSample in = field.sample({{x, y, 0.007 - 1e-9}}), out = field.sample({{x, y, 0.007 + 1e-9}});
      EXPECT_NEAR(in.distance_m, out.distance_m, 1e-8);
      EXPECT_LT(norm(in.gradient.v - out.gradient.v), 0.05);
    }
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
