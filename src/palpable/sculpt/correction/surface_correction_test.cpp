// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/surface_correction.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/touching_towers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kRadius = 0.02;

Mesh sphere_mesh(double radius_m, double spacing_m) {
  models::Superquadric s;
  s.size_m = {radius_m, radius_m, radius_m};
  return models::mesh_of(s, spacing_m);
}

/// The part of a sphere_mesh above z = cut: what a camera measured.
Mesh cap(double radius_m, double cut_m) {
  Mesh mesh = sphere_mesh(radius_m, 0.0015);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t i) { return mesh.vertices_m[i].z < cut_m; });
  });
  return mesh;
}

CorrectedSurface corrected(double by, double cut_m = 0.0) {
  auto predicted = predicted_surface(sphere_mesh(kRadius, 0.0013));
  EXPECT_TRUE(predicted.has_value());
  auto made =
      correct_surface(*std::move(predicted), cap((1.0 + by) * kRadius, cut_m), {0.004, 0.006}, Work{});
  EXPECT_TRUE(made.has_value());
  return *std::move(made);
}

TEST(SurfaceCorrection, KeepsSamplesAtOnePlaceFinite) {
  // In the middle of the edge where the towers touch, each has a sample. Only one of them is measured.
  auto towers = predicted_surface(touching_towers());
  ASSERT_TRUE(towers) << towers.error().message;
  const Mesh measured{{{1.3, 0.8, 0.2}, {0.8, 1.3, 0.2}, {1.05, 1.05, 0.9}}, {{0, 1, 2}}, {}};
  CorrectionOptions options;
  options.reach_m = 0.2, options.transition_m = 3.0, options.most_match_angle_deg = 60.0;
  const auto made = correct_surface(*std::move(towers), measured, options, Work{});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_GE(std::count(made->measured.begin(), made->measured.end(), true), 1);
  const Mesh adapted = made->adapted();
  EXPECT_TRUE(
      std::all_of(adapted.vertices_m.begin(), adapted.vertices_m.end(), [](Vec3 v) { return is_finite(v); }));
}

TEST(SurfaceCorrection, MovesHalfASphereOntoALargerAndASmallerOne) {
  for (const double by : {0.1, -0.1}) {
    const CorrectedSurface s = corrected(by);
    const Mesh adapted = s.adapted();
    EXPECT_TRUE(is_watertight(adapted));
    std::size_t pulled = 0;
    for (std::size_t i = 0; i < adapted.vertices_m.size(); ++i) {
      const Vec3 v = adapted.vertices_m[i];
      const double arc = kRadius * std::acos(std::clamp(s.predicted.vertices_m[i].z / kRadius, -1.0, 1.0));
      if (arc < 0.48 * 3.14159265 * kRadius) {
        EXPECT_TRUE(s.measured[i]);
        EXPECT_NEAR(norm(v) / kRadius, 1.0 + by, 0.005);
        ++pulled;
      }
      // Beyond the transition every sample is identical bit by bit.
      if (arc > 0.5 * 3.14159265 * kRadius + 0.0062) {
        EXPECT_EQ(s.translations_m[i], Vec3{});
      }
    }
    EXPECT_GT(pulled, 500U);
  }
}

TEST(SurfaceCorrection, LeavesNeitherStepNorCrease) {
  const CorrectedSurface s = corrected(0.1);
  // Radius by the arc from the pole, in bins: its slope changes no faster than the smooth phi's (6 / delta^2
  // times the displacement, with room for the mesh).
  constexpr double kBin = 0.0015;
  std::vector<double> sums(64), counts(64);
  for (std::size_t i = 0; i < s.translations_m.size(); ++i) {
    const auto bin = static_cast<std::size_t>(
        kRadius * std::acos(std::clamp(s.predicted.vertices_m[i].z / kRadius, -1.0, 1.0)) / kBin);
    sums[bin] += norm(s.predicted.vertices_m[i] + s.translations_m[i]);
    counts[bin] += 1.0;
  }
  std::vector<double> radius;
  for (std::size_t b = 6; b < 34; ++b) {
    ASSERT_GT(counts[b], 0.0);
    radius.push_back(sums[b] / counts[b]);
  }
  const double most = 6.0 * 0.1 * kRadius / (0.006 * 0.006) * kBin * kBin;
  for (std::size_t b = 1; b + 1 < radius.size(); ++b)
    EXPECT_LE(std::abs(radius[b + 1] - 2.0 * radius[b] + radius[b - 1]), 1.3 * most) << b;
}

TEST(SurfaceCorrection, AddsLaterMeasurementsWithoutChangingTheRest) {
  const CorrectedSurface first = corrected(0.1, 0.012);
  Mesh below = cap(1.1 * kRadius, 0.012);
  for (Vec3& v : below.vertices_m) v = {v.x, -v.y, -v.z};
  const auto second = correct_surface(first, below, {0.004, 0.006}, Work{});
  ASSERT_TRUE(second.has_value());
  for (std::size_t i = 0; i < first.translations_m.size(); ++i)
    if (first.predicted.vertices_m[i].z > 0.0) {
      EXPECT_EQ(second->translations_m[i], first.translations_m[i]);
    }
  const Box changed = bounds_of(second->changed());
  EXPECT_LT(changed.most_m.z, 0.0);
  EXPECT_NEAR(changed.least_m.z, -1.1 * kRadius, 2e-4);
}

/// A slab of 2 x 2 x 0.1 cm and the measured surface of its upper side, which faces upwards.
Mesh slab_surface() {
  models::Superquadric s;
  s.e1 = s.e2 = models::kLeastExponent;
  s.size_m = {0.01, 0.01, 0.0005};
  return models::mesh_of(s, 0.0005);
}
Mesh measured_plane(double height_m) {
  Mesh mesh;
  mesh.vertices_m = {
      {-0.02, -0.02, height_m}, {0.02, -0.02, height_m}, {0.02, 0.02, height_m}, {-0.02, 0.02, height_m}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(SurfaceCorrection, DoesNotPullTheBackOfASlabOntoItsMeasuredFront) {
  CorrectionOptions options{0.003, 0.002};
  options.most_match_angle_deg = 60.0;
  const auto made =
      correct_surface(*predicted_surface(slab_surface()), measured_plane(0.0008), options, Work{});
  ASSERT_TRUE(made);
  const Mesh adapted = made->adapted();
  int upper = 0;
  for (std::size_t i = 0; i < adapted.vertices_m.size(); ++i) {
    const Vec3 was = made->predicted.vertices_m[i];
    if (std::max(std::abs(was.x), std::abs(was.y)) > 0.007) continue;
    if (was.z > 0.0) {
      EXPECT_NEAR(adapted.vertices_m[i].z, 0.0008, 1e-5);
      ++upper;
    } else {
      EXPECT_EQ(adapted.vertices_m[i], was);
    }
  }
  EXPECT_GT(upper, 100);
}

TEST(SurfaceCorrection, TakesBackWhatWouldFoldTheSurface) {
  // A measured plane, and in a hole of it a stray patch of 2 x 2 mm 2 mm higher.
  Mesh step;
  const auto add = [&](double x0, double y0, double x1, double y1, double height_m) {
    const auto first = static_cast<std::uint32_t>(step.vertices_m.size());
    for (const Vec3 v : {Vec3{x0, y0, height_m}, {x1, y0, height_m}, {x1, y1, height_m}, {x0, y1, height_m}})
      step.vertices_m.push_back(v);
    step.triangles.push_back({first, first + 1, first + 2});
    step.triangles.push_back({first, first + 2, first + 3});
  };
  add(-0.001, -0.001, 0.001, 0.001, 0.0028);
  add(-0.02, -0.02, -0.001, 0.02, 0.0008), add(0.001, -0.02, 0.02, 0.02, 0.0008);
  add(-0.001, -0.02, 0.001, -0.001, 0.0008), add(-0.001, 0.001, 0.001, 0.02, 0.0008);
  CorrectionOptions options{0.004, 0.003};
  options.most_match_angle_deg = 60.0;
  const auto folded_at = [](const CorrectedSurface& s, double least_cosine) {
    const Mesh now = s.adapted();
    std::size_t count = 0;
    for (const auto& t : now.triangles) {
      const auto normal = [&](const Mesh& m) {
        return unit(cross(m.vertices_m[t[1]] - m.vertices_m[t[0]], m.vertices_m[t[2]] - m.vertices_m[t[0]]));
      };
      count += dot(normal(now), normal(s.predicted)) < least_cosine ? 1 : 0;
    }
    return count;
  };
  const double least_cosine = std::cos(60.0 * 3.14159265 / 180.0);
  const auto free = correct_surface(*predicted_surface(slab_surface()), step, options, Work{});
  ASSERT_TRUE(free);
  EXPECT_GT(folded_at(*free, least_cosine), 20U);
  options.most_turn_deg = 60.0;
  const auto held = correct_surface(*predicted_surface(slab_surface()), step, options, Work{});
  ASSERT_TRUE(held);
  EXPECT_EQ(folded_at(*held, least_cosine), 0U);
}

TEST(SurfaceCorrection, AveragesRepeatedMeasurementsUpToTheirNumber) {
  CorrectionOptions options{0.003, 0.002};
  options.averaged_measurements = 2;
  auto surface = predicted_surface(slab_surface());
  for (const double height_m : {0.0008, 0.0010, 0.0013}) {
    surface = correct_surface(*std::move(surface), measured_plane(height_m), options, Work{});
    ASSERT_TRUE(surface);
  }
  const Mesh adapted = surface->adapted();
  for (std::size_t i = 0; i < adapted.vertices_m.size(); ++i) {
    const Vec3 was = surface->predicted.vertices_m[i];
    // The mean of the first two is 0.9 mm; the third then counts as one of two.
    if (was.z > 0.0 && std::max(std::abs(was.x), std::abs(was.y)) < 0.007) {
      EXPECT_NEAR(adapted.vertices_m[i].z, 0.0011, 1e-5);
    }
  }
}

TEST(SurfaceCorrection, RefusesInvalidMeshesAndOptions) {
  Mesh open = sphere_mesh(kRadius, 0.002);
  open.triangles.pop_back();
  EXPECT_FALSE(predicted_surface(open));
  auto predicted = predicted_surface(sphere_mesh(kRadius, 0.002));
  ASSERT_TRUE(predicted.has_value());
  Mesh bad = cap(kRadius, 0.0);
  EXPECT_FALSE(correct_surface(*predicted, bad, {0.0, 0.006}, Work{}));
  bad.vertices_m[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(correct_surface(*predicted, bad, {}, Work{}));
  bad.vertices_m.clear();
  EXPECT_FALSE(correct_surface(*predicted, bad, {}, Work{}));
}

}  // namespace
}  // namespace palpable::sculpt
