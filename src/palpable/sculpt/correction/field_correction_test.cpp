// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/field_correction.hpp"

#include "palpable/models/field/field_leaf.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/solid/mesh_distance.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kRadius_m = 0.02, kTransition_m = 0.009, kReach_m = 0.004;

Mesh sphere(double radius_m, double spacing_m) {
  models::Superquadric s;
  s.size_m = {radius_m, radius_m, radius_m};
  return models::mesh_of(s, spacing_m);
}

FieldOptions options() {
  FieldOptions options;
  options.resolution = 48;
  options.max_error_m = 4e-5;
  return options;
}

CorrectedField ball() {
  const Mesh mesh = sphere(kRadius_m, 0.0012);
  return {field_from_source(*mesh_distance(mesh, mesh), options(), {}).value(),
          predicted_surface(mesh).value()};
}

/// The upper half of a sphere of another radius.
Mesh measured(double radius_m) {
  Mesh mesh = sphere(radius_m, 0.0012);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t i) { return mesh.vertices_m[i].z < -1e-9; });
  });
  return mesh;
}

/// The radius at which a ray from the middle leaves the solid.
double radius_along(const models::DistanceField& field, Vec3 direction) {
  double low = 0.5 * kRadius_m, high = 1.2 * kRadius_m;
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    (field.sample({middle * direction}).distance_m < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

class FieldCorrection : public testing::TestWithParam<double> {};

TEST_P(FieldCorrection, ReachesTheMeasuredSurfaceSmoothlyAndKeepsTheRestBitByBit) {
  const double radius_m = (1.0 + GetParam()) * kRadius_m;
  const CorrectedField before = ball();
  const auto after = corrected_field(before, measured(radius_m), {kReach_m, kTransition_m}, options(), {});
  ASSERT_TRUE(after) << after.error().sentence();
  const double cell_m = before.field.cell_m();

  // Along a meridian: within 0.5 % where measured, and the slope of the radius changes no faster than phi's.
  for (const double azimuth : {0.1, 1.2, 2.9, 4.0}) {
    std::vector<double> radius;
    constexpr double kStep = 0.04;
    for (double angle = 0.02; angle < std::numbers::pi - 0.02; angle += kStep) {
      const Vec3 d{std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
      radius.push_back(radius_along(after->field, d));
      if (angle < 0.5 * std::numbers::pi - 0.05) {
        EXPECT_NEAR(radius.back() / radius_m, 1.0, 0.005) << angle;
      }
      if (kRadius_m * (angle - 0.5 * std::numbers::pi) > kTransition_m) {
        EXPECT_NEAR(radius.back() / kRadius_m, 1.0, 0.005) << angle;
      }
    }
    // The angle between neighbouring facets of 1.2 mm is 0.06.
    const double steepest = 1.5 * std::abs(GetParam()) * kRadius_m / kTransition_m;
    const double most =
        (6.0 * std::abs(GetParam()) * kRadius_m / (kTransition_m * kTransition_m) * kRadius_m * kStep + 0.03 +
         0.1 * steepest) *
        kRadius_m * kStep;
    for (std::size_t i = 1; i + 1 < radius.size(); ++i)
      EXPECT_LE(std::abs(radius[i + 1] - 2.0 * radius[i] + radius[i - 1]), most) << i;
  }

  // Cells farther than transition + greatest displacement + two cells from what was measured.
  const double far_m = kTransition_m + std::abs(radius_m - kRadius_m) + 2.0 * cell_m;
  const models::FieldGrid& grid = before.field.grid();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int same = 0;
  for (int i = 0; i < 40000; ++i) {
    const auto cell = [&](std::size_t axis) { return static_cast<int>(uniform(random) * grid.cells(axis)); };
    const int x = cell(0), y = cell(1), z = cell(2);
    const models::DistanceField::Leaf was = before.field.leaf_of(x, y, z);
    if (grid.origin_m.z + cell_m * (was.corner[2] + was.side) > -far_m) continue;
    const models::DistanceField::Leaf is = after->field.leaf_of(x, y, z);
    ASSERT_EQ(is.side, was.side);
    const std::uint32_t* old_words = &before.field.tree().words[was.words];
    ASSERT_TRUE(std::equal(old_words, old_words + models::LeafHead{*old_words}.words(),
                           &after->field.tree().words[is.words]));
    ++same;
  }
  EXPECT_GT(same, 1000);
}

INSTANTIATE_TEST_SUITE_P(OutwardsAndInwards, FieldCorrection, testing::Values(0.1, -0.1));

TEST(FieldCorrection, CorrectingAgainByTheSameSurfaceChangesNothing) {
  const auto once =
      corrected_field(ball(), measured(1.05 * kRadius_m), {kReach_m, kTransition_m}, options(), {});
  ASSERT_TRUE(once);
  const auto twice =
      corrected_field(*once, measured(1.05 * kRadius_m), {kReach_m, kTransition_m}, options(), {});
  ASSERT_TRUE(twice);
  EXPECT_TRUE(twice->surface.moved.empty());
  EXPECT_EQ(twice->field.tree().words, once->field.tree().words);
}

/// A cap of the ball's surface around +z, `out_m` farther out.
Mesh cap(double out_m) {
  Mesh mesh = sphere(kRadius_m + out_m, 0.0012);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t i) { return mesh.vertices_m[i].z < 0.8 * kRadius_m; });
  });
  return mesh;
}

/// The solid described by a corrected field.
const DistanceSource& solid_of(const CorrectedField& field) { return *field.solid; }

TEST(FieldCorrection, GivesTheCorrectedDistanceNearTheSurfaceAndBlendsSmoothlyIntoTheOldOne) {
  const CorrectedField before = ball();
  const auto after = corrected_field(before, cap(0.0005), {kReach_m, kTransition_m}, options(), {});
  ASSERT_TRUE(after) << after.error().sentence();
  ASSERT_FALSE(after->rebuilt);
  const double within_m = kTransition_m + 0.0005 + 2.0 * before.field.cell_m();
  double last_m = 0.0;
  for (double depth_m = -0.001; depth_m < 0.018; depth_m += 0.00005) {
    const Vec3 p{0.0003, 0.0002, kRadius_m + 0.0005 - depth_m};
    DistanceSource::Hint hint;
    const double truth_m = solid_of(*after).at(p, hint).distance_m;
    const models::FieldSample is = after->field.sample({p});
    if (depth_m < 0.0029) {
      EXPECT_NEAR(is.distance_m, truth_m, 1e-4) << depth_m;
    }
    if (depth_m > within_m) {
      EXPECT_NEAR(is.distance_m, before.field.sample({p}).distance_m, 4e-5) << depth_m;
    }
    // The depth increases along the whole path.
    if (depth_m > 0.0 && depth_m < 0.015) {
      EXPECT_LT(is.distance_m, last_m) << depth_m;
      EXPECT_GT(is.gradient.v.z, 0.4) << depth_m;
    }
    last_m = is.distance_m;
  }
}

TEST(FieldCorrection, GivesTheCorrectedDistanceEverywhereIfThatIsTheVolume) {
  CorrectionOptions correction{kReach_m, kTransition_m, CorrectedVolume::everywhere};
  const auto after = corrected_field(ball(), cap(0.0005), correction, options(), {});
  ASSERT_TRUE(after) << after.error().sentence();
  const Vec3 p{0.0003, 0.0002, 0.008};
  DistanceSource::Hint hint;
  EXPECT_NEAR(after->field.sample({p}).distance_m, solid_of(*after).at(p, hint).distance_m, 2e-4);
}

TEST(FieldCorrection, IsBuiltAgainIfManySmallCorrectionsAddUp) {
  CorrectedField field = ball();
  bool anew = false;
  for (int step = 1; step <= 12 && !anew; ++step) {
    auto next = corrected_field(std::move(field), cap(-0.0009 * step), {0.02, 0.002}, options(), {});
    ASSERT_TRUE(next) << next.error().sentence();
    anew = next->rebuilt;
    field = *std::move(next);
  }
  EXPECT_TRUE(anew);
}

}  // namespace
}  // namespace palpable::sculpt
