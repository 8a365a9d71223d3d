// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// models::field_of() on fields of meshes of many sizes: the heights seen from above equal those of the solid.

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/models/field/field.hpp"
#include "palpable/sculpt/field/dense_field_from_source.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr int kResolution = 16;

/// Sizes as they come from --size, from inputs in other units, and from scaling by factors that binary
/// fractions cannot hold.
constexpr std::array<double, 20> kSizes_m = {0.01, 0.02,  0.025,  0.03, 0.033,  0.04, 0.0473,
                                             0.05, 0.06,  0.0667, 0.07, 0.0777, 0.08, 0.09,
                                             0.1,  0.101, 0.1234, 0.15, 0.2,    0.3};

/// A solid of revolution about z with the profile radius(t), t from 0 (bottom) to 1 (top), on z = 0.
template <class Radius>
Mesh revolved(double height_m, Radius radius_m) {
  constexpr unsigned kRings = 6, kSectors = 16;
  Mesh mesh;
  for (unsigned r = 0; r <= kRings; ++r)
    for (unsigned s = 0; s < kSectors; ++s) {
      const double t = static_cast<double>(r) / kRings, angle = 2.0 * std::numbers::pi * s / kSectors;
      mesh.vertices_m.push_back({radius_m(t) * std::cos(angle), radius_m(t) * std::sin(angle), t * height_m});
    }
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices_m.size()), top = bottom + 1;
  mesh.vertices_m.push_back({0.0, 0.0, 0.0});
  mesh.vertices_m.push_back({0.0, 0.0, height_m});
  for (unsigned s = 0; s < kSectors; ++s) {
    const unsigned next = (s + 1) % kSectors;
    mesh.triangles.push_back({bottom, next, s});
    mesh.triangles.push_back({top, kRings * kSectors + s, kRings * kSectors + next});
    for (unsigned r = 0; r < kRings; ++r) {
      const unsigned low = r * kSectors, high = low + kSectors;
      mesh.triangles.push_back({low + s, low + next, high + next});
      mesh.triangles.push_back({low + s, high + next, high + s});
    }
  }
  return mesh;
}

struct Shape {
  const char* name;
  Mesh mesh;
};

/// As high as they are wide, so that they fill a cube.
std::vector<Shape> shapes_of(double size_m) {
  const double half_m = 0.5 * size_m;
  return {{"box", box_mesh({-half_m, -half_m, 0.0}, {half_m, half_m, size_m})},
          {"cylinder", revolved(size_m, [&](double) { return half_m; })},
          {"cone", revolved(size_m, [&](double t) { return half_m * (1.0 - 0.95 * t); })},
          {"barrel", revolved(size_m, [&](double t) {
             return half_m * (1.0 - (2.0 * t - 1.0) * (2.0 * t - 1.0) / 2.0);
           })}};
}

/// The heights of `shape` seen from above, with the representation of `sample`.
template <class Sample>
void expect_top_at(const Shape& shape, double size_m, Sample sample) {
  const auto solid = solid_from_mesh(shape.mesh, size_m / kResolution, {});
  ASSERT_TRUE(solid) << shape.name;
  auto distance = sample(*solid->distance);
  ASSERT_TRUE(distance) << shape.name;
  const Box box = solid->distance->bounds();
  const auto field = models::field_of(*std::move(distance), box.least_m, box.most_m);
  ASSERT_TRUE(field) << shape.name;
  const double cell_m = size_m / kResolution;
  EXPECT_NEAR(field->from_above->highest_m(), size_m, cell_m) << shape.name << " of " << size_m << " m";
  EXPECT_NEAR(field->from_above->sample(0.0, 0.0).z_m, size_m, cell_m)
      << shape.name << " of " << size_m << " m";
}

TEST(FieldFromAbove, ReachTheTopOfASolidOfEverySize) {
  for (const double size_m : kSizes_m)
    expect_top_at(shapes_of(size_m).front(), size_m, [&](const DistanceSource& source) {
      FieldOptions options;
      options.resolution = kResolution;
      options.max_error_m = 0.01 * size_m;
      return field_from_source(source, options, {});
    });
}

TEST(FieldFromAbove, ReachTheTopOfDenselyKeptSolidsToo) {
  for (const double size_m : kSizes_m)
    for (const Shape& shape : shapes_of(size_m))
      expect_top_at(shape, size_m, [](const DistanceSource& source) {
        DenseFieldOptions options;
        options.resolution = kResolution;
        return dense_field_from_source(source, options, {});
      });
}

}  // namespace
}  // namespace palpable::sculpt
