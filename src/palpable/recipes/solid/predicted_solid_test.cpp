// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/predicted_solid.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

/// A ball of 40 mm whose surface rises and falls by 2 mm.
Mesh bumpy_ball() {
  models::Superquadric ball;
  ball.size_m = {0.02, 0.02, 0.02};
  Mesh mesh = models::mesh_of(ball, 0.001);
  for (Vec3& v : mesh.vertices_m) v *= 1.0 + 0.05 * std::sin(200.0 * v.x) * std::sin(200.0 * v.y);
  return mesh;
}

PredictionOptions coarse() {
  PredictionOptions options;
  options.samples = 48;
  return options;
}

TEST(PredictedSolid, OfSuperquadricsIsTheSuperquadrics) {
  models::Superquadric box;
  box.size_m = {0.03, 0.02, 0.01}, box.e1 = box.e2 = 0.2;
  models::Superquadric ball;
  ball.size_m = {0.012, 0.012, 0.012};
  ball.scene_from_shape.translation_m = {0.0, 0.0, 0.018};
  const auto solid = sculpt::distance_of(std::vector{box, ball});
  ASSERT_TRUE(solid);
  const auto predicted = predicted_solid(**solid, coarse(), {});
  ASSERT_TRUE(predicted) << predicted.error().message;
  EXPECT_EQ(predicted->shapes.size(), 2U);
  EXPECT_LT(predicted->predicted_error_m, 0.0002);
  EXPECT_LE(predicted->corrected_error_m, predicted->predicted_error_m);
}

TEST(PredictedSolid, FollowsASurfaceThatNoShapeFits) {
  const auto solid = sculpt::solid_from_mesh(bumpy_ball(), 0.0002, {});
  ASSERT_TRUE(solid);
  const auto predicted = predicted_solid(*solid->distance, coarse(), {});
  ASSERT_TRUE(predicted) << predicted.error().message;
  EXPECT_GT(predicted->predicted_error_m, 0.0001);
  ASSERT_FALSE(predicted->surface.triangles.empty());
  EXPECT_LT(predicted->corrected_error_m, 0.2 * predicted->predicted_error_m);
}

/// The mean distance of the bumpy ball's corners from the surface of its field.
double error_of_field(SolidSurface surface, std::size_t& primitives, std::string& method) {
  FieldRecipe recipe;
  recipe.placement.default_size = sculpt::DefaultSize::own;
  recipe.placement.convention = {AxisDirection::plus_y, LengthUnit::metre};
  recipe.field.resolution = 64;
  recipe.surface = surface;
  recipe.prediction = coarse();
  const auto made = field_from_mesh(bumpy_ball(), recipe, {});
  EXPECT_TRUE(made) << made.error().message;
  const auto& field = *std::get<std::shared_ptr<const models::Field>>(made->scene.model);
  primitives = field.primitives.size();
  method = made->scene.source.method;
  double sum_m = 0.0;
  const Mesh ball = bumpy_ball();
  for (const Vec3 v : ball.vertices_m)
    sum_m += std::abs(
        field.distance.sample(made->scene.scene_from_input * Point<models::InputFrame>{v}).distance_m);
  return sum_m / static_cast<double>(ball.vertices_m.size()) / made->scene.scene_from_input.scale;
}

TEST(PredictedSolid, IsTheFieldThatARecipeAsksFor) {
  std::size_t primitives = 0;
  std::string method;
  const double exact_m = error_of_field(SolidSurface::given, primitives, method);
  EXPECT_EQ(primitives, 0U);
  EXPECT_EQ(method.rfind("field of mesh, 64 cells", 0), 0U) << method;
  const double predicted_m = error_of_field(SolidSurface::superquadrics, primitives, method);
  EXPECT_GT(primitives, 0U);
  EXPECT_EQ(method.rfind("field of mesh, by superquadrics, 64 cells", 0), 0U) << method;
  const double corrected_m = error_of_field(SolidSurface::corrected, primitives, method);
  EXPECT_GT(primitives, 0U);
  EXPECT_EQ(method.rfind("field of mesh, by superquadrics, corrected, 64 cells", 0), 0U) << method;
  EXPECT_LT(exact_m, corrected_m);
  EXPECT_LT(corrected_m, 0.3 * predicted_m);
}

}  // namespace
}  // namespace palpable::recipes
