// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/field_from_source.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

TEST(FieldFromSource, FollowsABall) {
  const Ball ball(0.03);
  FieldOptions options;
  options.resolution = 128;
  options.max_error_m = 1e-5;
  const auto field = field_from_source(ball, options, {});
  ASSERT_TRUE(field);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-0.003, 0.001);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 n = unit({normal(random), normal(random), normal(random)});
    const double distance = uniform(random);
    const models::FieldSample s = field->sample({(0.03 + distance) * n});
    ASSERT_NEAR(s.distance_m, distance, 1e-5);
    ASSERT_NEAR(norm(s.gradient.v), 1.0, 0.02);
    ASSERT_GT(dot(unit(s.gradient.v), n), std::cos(1.0 / 57.3));
  }
}

/// A torus around z with a tube thickness of 12 mm.
class Ring final : public DistanceSource {
 public:
  static constexpr double kRing_m = 0.03, kTube_m = 0.012;
  models::DistanceSample at(Vec3 p, Hint&) const override {
    const double across_m = std::hypot(p.x, p.y), out_m = across_m - kRing_m;
    const double length_m = std::max(std::hypot(out_m, p.z), 1e-12);
    const double by_across = across_m > 0.0 ? out_m / (length_m * across_m) : 0.0;
    return {length_m - kTube_m, {by_across * p.x, by_across * p.y, p.z / length_m}};
  }
  Box bounds() const override {
    constexpr double kWidth_m = kRing_m + kTube_m;
    return {{-kWidth_m, -kWidth_m, -kTube_m}, {kWidth_m, kWidth_m, kTube_m}};
  }
};

TEST(FieldFromSource, KeepsTheGradientsLengthNearOneWhereTheDistanceIsSmooth) {
  const auto field = field_from_source(Ring(), {.resolution = 192}, {});
  ASSERT_TRUE(field);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  struct Lengths {
    int count = 0, over = 0;
    double greatest = 0.0;
  } near, outside;
  DistanceSource::Hint hint;
  const Vec3 size = field->size_m();
  for (int i = 0; i < 200000; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p = field->origin_m() + Vec3{x * size.x, y * size.y, z * size.z};
    const double distance_m = Ring().at(p, hint).distance_m;
    // The distance has a kink on the axis.
    if (std::hypot(p.x, p.y) < 0.004 || distance_m < -0.003) continue;
    Lengths& lengths = distance_m < 0.001 ? near : outside;
    const double length = norm(field->sample({p}).gradient);
    ++lengths.count;
    lengths.over += length > 1.05 ? 1 : 0;
    lengths.greatest = std::max(lengths.greatest, length);
  }
  EXPECT_LE(near.over, near.count / 1000);
  EXPECT_LT(near.greatest, 1.1);
  // There the error bound of the distance itself is greater.
  EXPECT_LE(outside.over, outside.count / 50);
  EXPECT_LT(outside.greatest, 1.5);
}

TEST(FieldFromSource, HoldsABoxInFewExactLeaves) {
  const Vec3 low{-0.02, -0.015, -0.01}, high{0.02, 0.015, 0.01};
  const auto solid = solid_from_mesh(box_mesh(low, high), 1e-4, {});
  ASSERT_TRUE(solid);
  FieldOptions options;
  options.resolution = 256;
  const auto field = field_from_source(*solid->distance, options, {});
  ASSERT_TRUE(field);
  // A dense field of this box has 256 x 192 x 128 cells.
  EXPECT_LT(field->leaves(), 60000U);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double worst = 0.0;
  for (int i = 0; i < 30000; ++i) {
    const Vec3 p{0.021 * uniform(random), 0.016 * uniform(random), 0.011 * uniform(random)};
    worst = std::max(worst, std::abs(field->sample({p}).distance_m - box_distance(p, low, high)));
  }
  // Edges and medial sheets among them.
  EXPECT_LT(worst, 0.4 * field->cell_m());
}

/// Next to a very narrow gap, the nearest faces face away from each other.
class Ridge final : public DistanceSource {
 public:
  models::DistanceSample at(Vec3 p, Hint&) const override {
    return {0.001 + std::abs(p.x), {p.x < 0.0 ? -1.0 : 1.0, 0.0, 0.0}};
  }
  Box bounds() const override { return {{-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}}; }
};

TEST(FieldFromSource, GivesANumberWhereFacesStandBackToBack) {
  FieldOptions options;
  options.resolution = 32;
  const auto field = field_from_source(Ridge{}, options, {});
  ASSERT_TRUE(field);
  for (int i = -90; i <= 90; ++i) {
    const double x = 1e-4 * i;
    EXPECT_NEAR(field->sample({{x, 0.002, -0.003}}).distance_m, 0.001 + std::abs(x), 2e-4) << x;
  }
}

TEST(FieldFromSource, IsTheSameForAnyNumberOfThreads) {
  const Ball ball(0.02);
  FieldOptions options;
  options.resolution = 32;
  Work one;
  one.threads = 1;
  Work three;
  three.threads = 3;
  const auto a = field_from_source(ball, options, one), b = field_from_source(ball, options, three);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->tree().roots, b->tree().roots);
  EXPECT_EQ(a->tree().nodes, b->tree().nodes);
  EXPECT_EQ(a->tree().words, b->tree().words);
}

TEST(FieldFromSource, StopsWhenCancelled) {
  const std::atomic<bool> cancel{true};
  Work work;
  work.cancel = &cancel;
  const auto field = field_from_source(Ball(0.02), {}, work);
  ASSERT_FALSE(field);
  EXPECT_EQ(field.error().code, ErrorCode::interrupted);
}

TEST(FieldFromSource, RefusesWhatCannotBeSampled) {
  FieldOptions options;
  options.resolution = 5000;
  EXPECT_FALSE(field_from_source(Ball(0.02), options, {}));
  EXPECT_FALSE(field_from_source(Ball(0.0), {}, {}));
  EXPECT_FALSE(field_from_source(Ball(1e-6), {}, {}));
}

TEST(FieldFromSource, RefusesWhatWouldTakeTooMuchMemoryAndSaysWhatFits) {
  FieldOptions options;
  options.resolution = 128;
  options.most_bytes = 20000;
  const auto refused = field_from_source(Ball(0.02), options, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::failed);
  EXPECT_NE(refused.error().message.find("cells would fit"), std::string::npos) << refused.error().message;
}

/// Counts its queries.
class Asked final : public DistanceSource {
 public:
  models::DistanceSample at(Vec3 p, Hint& hint) const override {
    ++count;
    return ball_.at(p, hint);
  }
  Box bounds() const override { return ball_.bounds(); }
  mutable std::atomic<std::size_t> count{0};

 private:
  Ball ball_{0.02};
};

TEST(FieldFromSource, RefusesLongBeforeTheMemoryIsTaken) {
  FieldOptions options;
  options.resolution = 128;
  const Asked whole, refused;
  const auto field = field_from_source(whole, options, {});
  ASSERT_TRUE(field);
  options.most_bytes = field->memory_bytes() / 2;
  const auto error = field_from_source(refused, options, {});
  ASSERT_FALSE(error);
  EXPECT_LT(refused.count, whole.count / 5);
}

/// RMS difference of a field's distance from a solid's within a millimetre of the surface, at places at most
/// `reach_m` from the origin along each axis.
double rms_near_surface_m(const models::DistanceField& field, const DistanceSource& solid, double reach_m) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> uniform(-reach_m, reach_m);
  DistanceSource::Hint hint;
  double squares = 0.0;
  constexpr int kPlaces = 3000;
  for (int count = 0; count < kPlaces;) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const double distance_m = field.sample({{x, y, z}}).distance_m;
    if (std::abs(distance_m) > 0.001) continue;
    squares += std::pow(distance_m - solid.at({x, y, z}, hint).distance_m, 2);
    ++count;
  }
  return std::sqrt(squares / kPlaces);
}

TEST(FieldFromSource, FollowsAScanOnlyAsCloselyAsItsFacetsAgree) {
  constexpr double kRadius_m = 0.006, kSide_m = 0.0006;
  constexpr FieldOptions kField{.resolution = 64, .max_error_m = 1e-5};
  models::Superquadric ball;
  ball.size_m = {kRadius_m, kRadius_m, kRadius_m};
  Mesh noisy = models::mesh_of(ball, kSide_m);
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (Vec3& v : noisy.vertices_m) v = (1.0 + 0.04 * kSide_m / kRadius_m * uniform(random)) * v;
  const auto field_of = [&](const Mesh& mesh, const FacetOptions& facets) {
    const auto solid = solid_from_mesh(mesh, 2.0 * kRadius_m / kField.resolution, {}, facets);
    return field_from_source(*solid->distance, kField, {});
  };
  const FacetOptions as_chosen{.rounding_m = 1.5e-5};
  FacetOptions closely = as_chosen;
  closely.noise_turn_share = closely.noise_rise_share = 0.0;
  const auto followed = field_of(noisy, closely), field = field_of(noisy, as_chosen);
  ASSERT_TRUE(followed && field);
  EXPECT_LT(2 * field->memory_bytes(), followed->memory_bytes());
  // It stays close to the facets.
  const auto facets = solid_from_mesh(noisy, 1e-4, {});
  EXPECT_LT(rms_near_surface_m(*field, *facets->distance, 1.1 * kRadius_m), 8e-6);
  // The facets of a smooth surface are consistent, so almost nothing is omitted.
  const Mesh fine = models::mesh_of(ball, 0.5 * kSide_m);
  const auto smooth = field_of(fine, as_chosen), smooth_closely = field_of(fine, closely);
  ASSERT_TRUE(smooth && smooth_closely);
  EXPECT_GT(10 * smooth->memory_bytes(), 8 * smooth_closely->memory_bytes());
}

TEST(FieldFromSource, FollowsOverlappingCurvedBodiesOnlyAsCloselyAsTheirFacets) {
  constexpr double kRadius_m = 0.006, kSide_m = 0.0006;
  constexpr FieldOptions kField{.resolution = 96, .max_error_m = 1e-5};
  models::Superquadric ball;
  ball.size_m = {kRadius_m, kRadius_m, kRadius_m};
  Mesh beside = models::mesh_of(ball, kSide_m);
  for (Vec3& v : beside.vertices_m) v += Vec3{0.5 * kRadius_m, 0.1 * kRadius_m, 0.2 * kRadius_m};
  const Mesh balls = together(models::mesh_of(ball, kSide_m), beside);
  const auto field_of = [&](const Mesh& mesh, const FacetOptions& facets) {
    const auto solid = solid_from_mesh(mesh, 2.5 * kRadius_m / kField.resolution, {}, facets);
    return field_from_source(*solid->distance, kField, {});
  };
  const FacetOptions as_chosen{.rounding_m = 1.5e-5};
  FacetOptions closely = as_chosen;
  closely.cut_rise_share = closely.cut_turn_share = 0.0;
  const auto followed = field_of(balls, closely), field = field_of(balls, as_chosen);
  ASSERT_TRUE(followed && field);
  EXPECT_LT(2 * field->memory_bytes(), followed->memory_bytes());
  const auto facets = solid_from_mesh(balls, 1e-4, {});
  EXPECT_LT(rms_near_surface_m(*field, *facets->distance, 1.1 * kRadius_m), 8e-6);
  // Edges and flat faces are the mesh's own shape.
  const Mesh boxes = together(box_mesh({-0.006, -0.006, -0.006}, {0.004, 0.004, 0.004}),
                              box_mesh({-0.001, -0.002, -0.003}, {0.006, 0.006, 0.006}));
  EXPECT_EQ(field_of(boxes, as_chosen)->tree().words, field_of(boxes, closely)->tree().words);
}

}  // namespace
}  // namespace palpable::sculpt
