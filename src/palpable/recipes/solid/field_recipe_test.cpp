// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/field_recipe.hpp"

#include "palpable/recipes/relief/relief_recipe.hpp"

#include <functional>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

Mesh tetrahedron() {
  Mesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

TEST(FieldRecipe, WithAnOptionOutOfRangeIsAnErrorOfUsage) {
  const std::function<void(FieldRecipe&)> wrong[] = {
      [](FieldRecipe& r) { r.walls.least_cells = 99; }, [](FieldRecipe& r) { r.walls.least_points = 9; },
      [](FieldRecipe& r) { r.sheets.least_lid = 5; }, [](FieldRecipe& r) { r.field.inside_m = -1; }};
  for (const auto& change : wrong) {
    FieldRecipe recipe;
    change(recipe);
    const auto made = field_from_mesh(tetrahedron(), recipe, {});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::usage);
  }
}

TEST(FieldRecipe, RefusesShapesThatAreTooThinToBeFelt) {
  models::Superquadric near;
  near.size_m = {0.02, 0.015, 1e-5};
  models::Superquadric far = near;
  far.scene_from_shape.translation_m = {0.1, 0.0, 0.0};
  FieldRecipe recipe;
  recipe.field.resolution = 64;
  const auto made = field_from_superquadrics({near, far}, recipe, {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::invalid_input);
  EXPECT_EQ(made.error().message.find("holds only shapes that are thinner than half a cell of the field"), 0U)
      << made.error().message;
}

TEST(ReliefRecipe, WithAnOptionOutOfRangeIsAnErrorOfUsage) {
  ReliefRecipe recipe;
  recipe.ground_options.plane.trials = -1;
  const auto made = relief_from_depth({DepthMap{Raster<float>(4, 4, 1.0F), {}}, {}}, recipe, {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::usage);
}

TEST(ReliefRecipe, RefusesAPictureWithoutItsSamples) {
  const Image empty{96, 64, 1, 8, {}};
  const vision::StereoPair pair{empty, empty, {}};
  const auto made = relief_from_pair(pair, {}, {}, {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace palpable::recipes
