// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/superquadric.hpp"

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/models/field/superquadric_distance.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

Superquadric shape_of(Vec3 size_m, double e1, double e2) {
  Superquadric s;
  s.size_m = size_m;
  s.e1 = e1;
  s.e2 = e2;
  return s;
}

SuperquadricDistance distance_to(const Superquadric& shape) {
  auto made = SuperquadricDistance::from(shape);
  EXPECT_TRUE(made.has_value());
  return *std::move(made);
}

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 in_box(Vec3 half) { return {in(-half.x, half.x), in(-half.y, half.y), in(-half.z, half.z)}; }
  Transform<SceneFrame, ShapeFrame> pose() {
    std::normal_distribution<double> normal;
    std::array<double, 4> q{normal(random_), normal(random_), normal(random_), normal(random_)};
    const double n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& part : q) part /= n;
    return {rotation_of(q), {in(-1, 1), in(-1, 1), in(-1, 1)}, 1.0};
  }

 private:
  std::mt19937 random_;
};

/// The distance to the nearest vertex of a fine mesh: a close upper bound.
double brute_force_m(const Mesh& mesh, Vec3 p) {
  double best = 1e300;
  for (const Vec3 v : mesh.vertices_m) best = std::min(best, squared_norm(v - p));
  return std::sqrt(best);
}

TEST(Superquadric, IsAnEllipsoidWithExponentsOfOne) {
  const Superquadric s = shape_of({2.0, 3.0, 4.0}, 1.0, 1.0);
  EXPECT_NEAR(gauge(s, {2.0, 0.0, 0.0}), 1.0, 1e-15);
  EXPECT_NEAR(gauge(s, {1.0, 1.5, 2.0}), std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(inside_outside(s, {{4.0, 0.0, 0.0}}), 4.0, 1e-12);
}

TEST(Superquadric, StaysFiniteAtTheExponentsLimits) {
  for (const double e1 : {kLeastExponent, 1.9})
    for (const double e2 : {kLeastExponent, 1.9}) {
      const Superquadric s = shape_of({1e-3, 1.0, 1e3}, e1, e2);
      for (const Vec3 p : {Vec3{}, Vec3{-1e6, 1e-9, 1e6}, Vec3{0.0, -1.0, 0.0}, Vec3{1e-12, 1e-12, -1e-12}}) {
        Vec3 g;
        EXPECT_TRUE(std::isfinite(gauge(s, p, g)));
        EXPECT_TRUE(is_finite(g));
      }
    }
}

TEST(Superquadric, ComputesTheGradientOfItsGauge) {
  Draw draw(3);
  for (int k = 0; k < 200; ++k) {
    const Superquadric s =
        shape_of({1.0, 0.7, 1.4}, draw.in(kLeastExponent, 1.9), draw.in(kLeastExponent, 1.9));
    const Vec3 p = draw.in_box({2.0, 2.0, 2.0});
    Vec3 g;
    gauge(s, p, g);
    const double h = 1e-6;
    const auto by = [&](Vec3 d) { return (gauge(s, p + h * d) - gauge(s, p - h * d)) / (2.0 * h); };
    EXPECT_LT(norm(g - Vec3{by({1, 0, 0}), by({0, 1, 0}), by({0, 0, 1})}), 1e-4);
  }
}

TEST(Superquadric, InvertsItsDeformation) {
  Draw draw(4);
  for (int k = 0; k < 500; ++k) {
    Superquadric s = shape_of({0.5, 0.4, 1.0}, 0.5, 0.5);
    s.taper_x = draw.in(-0.9, 0.9);
    s.taper_y = draw.in(-0.9, 0.9);
    s.bend_per_m = k % 5 == 0 ? 1e-12 : draw.in(0.0, 0.9);
    s.bend_angle_rad = draw.in(-3.1, 3.1);
    const Vec3 p = draw.in_box(s.size_m);
    EXPECT_LT(norm(undeform(s, deform(s, p)) - p), 1e-9);
    const DeformedPoint d = deform_with_jacobian(s, p);
    EXPECT_LT(norm(d.place - deform(s, p)), 1e-12);
    const double h = 1e-6;
    const Vec3 by_z = (deform(s, p + Vec3{0, 0, h}) - deform(s, p - Vec3{0, 0, h})) / (2.0 * h);
    const Vec3 by_x = (deform(s, p + Vec3{h, 0, 0}) - deform(s, p - Vec3{h, 0, 0})) / (2.0 * h);
    EXPECT_LT(norm(d.by_z - by_z) + norm(d.by_x - by_x), 1e-6);
  }
}

TEST(Superquadric, ConvertsQuaternionsToRotationsAndBack) {
  Draw draw(5);
  for (int k = 0; k < 100; ++k) {
    const auto r = draw.pose().rotation;
    const auto again = rotation_of(quaternion_of(r));
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(again[i], r[i], 1e-12);
  }
}

TEST(Superquadric, RefusesInvalidParameters) {
  EXPECT_FALSE(check_superquadric(shape_of({0.0, 1.0, 1.0}, 1.0, 1.0)));
  EXPECT_FALSE(check_superquadric(shape_of({1.0, 1.0, 1.0}, 0.04, 1.0)));
  EXPECT_FALSE(check_superquadric(shape_of({1.0, 1.0, 1.0}, 1.0, std::nan(""))));
  Superquadric bent = shape_of({1.0, 1.0, 1.0}, 1.0, 1.0);
  bent.bend_per_m = 2.0;
  EXPECT_FALSE(check_superquadric(bent));
}

TEST(SuperquadricDistance, IsExactForASphere) {
  Superquadric s = shape_of({0.5, 0.5, 0.5}, 1.0, 1.0);
  Draw draw(6);
  s.scene_from_shape = draw.pose();
  const auto sphere = distance_to(s);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p = s.scene_from_shape.translation_m + draw.in_box({1.0, 1.0, 1.0});
    const Vec3 from_centre = p - s.scene_from_shape.translation_m;
    const ClosestPoint c = sphere.closest_point({p});
    EXPECT_NEAR(c.distance_m, norm(from_centre) - 0.5, 1e-10);
    EXPECT_LT(norm(c.normal.v - unit(from_centre)), 1e-6);
  }
}

TEST(SuperquadricDistance, AgreesWithABruteForceSearchForEveryExponent) {
  Draw draw(7);
  for (const double e1 : {kLeastExponent, 0.5, 1.0, 1.2, 1.9})
    for (const double e2 : {kLeastExponent, 0.5, 1.0, 1.2, 1.9}) {
      const Superquadric s = shape_of({1.0, 0.6, 0.35}, e1, e2);
      const auto shape = distance_to(s);
      const Mesh fine = mesh_of(s, 0.02);
      for (int k = 0; k < 40; ++k) {
        Vec3 p = draw.in_box({1.5, 1.0, 0.7});
        if (k % 8 == 0) p.z = 0.0;
        if (k % 8 == 1) p.x = 0.0;
        const ClosestPoint c = shape.closest_point({p});
        const double brute = brute_force_m(fine, p);
        EXPECT_LE(std::abs(c.distance_m), brute + 1e-9)
            << e1 << ' ' << e2 << " at " << p.x << ' ' << p.y << ' ' << p.z;
        EXPECT_GE(std::abs(c.distance_m), brute - 0.02) << e1 << ' ' << e2;
        EXPECT_NEAR(gauge(s, c.surface.v), 1.0, 1e-9);
        EXPECT_EQ(c.distance_m < 0.0, gauge(s, p) < 1.0);
      }
    }
}

TEST(SuperquadricDistance, HasUnitSlopeAlongItsNormal) {
  Draw draw(8);
  for (int k = 0; k < 300; ++k) {
    const Superquadric s =
        shape_of({1.0, 0.8, 0.5}, draw.in(kLeastExponent, 1.9), draw.in(kLeastExponent, 1.9));
    const auto shape = distance_to(s);
    const Vec3 on = on_surface(s, draw.in_box({1.0, 1.0, 1.0}));
    const ClosestPoint c = shape.closest_point({on + 0.3 * surface_normal(s, on)});
    EXPECT_NEAR(c.distance_m, 0.3, 1e-7) << s.e1 << ' ' << s.e2;
    EXPECT_LT(norm(c.surface.v - on), 1e-4) << s.e1 << ' ' << s.e2;
  }
}

TEST(SuperquadricDistance, FollowsTaperAndBend) {
  Draw draw(9);
  for (int k = 0; k < 12; ++k) {
    Superquadric s = shape_of({0.4, 0.3, 1.0}, draw.in(kLeastExponent, 1.5), draw.in(kLeastExponent, 1.5));
    s.taper_x = draw.in(-0.6, 0.6);
    s.taper_y = draw.in(-0.6, 0.6);
    s.bend_per_m = draw.in(0.0, 1.0);
    s.bend_angle_rad = draw.in(-3.0, 3.0);
    s.scene_from_shape = draw.pose();
    const auto shape = distance_to(s);
    const Mesh fine = mesh_of(s, 0.02);
    for (int i = 0; i < 40; ++i) {
      const Point<SceneFrame> p = s.scene_from_shape * Point<ShapeFrame>{draw.in_box({1.2, 1.2, 1.2})};
      const ClosestPoint c = shape.closest_point(p);
      const double brute = brute_force_m(fine, p.v);
      EXPECT_LE(std::abs(c.distance_m), brute + 1e-9);
      EXPECT_GE(std::abs(c.distance_m), brute - 0.02);
    }
  }
}

TEST(SuperquadricSamples, FormAClosedMesh) {
  Superquadric s = shape_of({0.4, 0.3, 1.0}, 0.3, 0.7);
  s.taper_x = 0.5;
  s.bend_per_m = 0.8;
  const Mesh mesh = mesh_of(s, 0.1);
  EXPECT_TRUE(is_watertight(mesh));
  double six_volumes = 0.0;
  for (const auto& t : mesh.triangles)
    six_volumes += dot(mesh.vertices_m[t[0]], cross(mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]));
  EXPECT_GT(six_volumes, 0.0);
}

}  // namespace
}  // namespace palpable::models
