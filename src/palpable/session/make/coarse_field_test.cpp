// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/coarse_field.hpp"

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

TEST(CoarseField, IsOfferedForALargeMeshWhoseFieldIsFine) {
  Mesh mesh;
  mesh.triangles.resize(5000);
  recipes::FieldRecipe requested;
  requested.field.resolution = 512;
  const auto coarse = coarse_recipe({}, mesh, requested);
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->field.resolution, 96);
  EXPECT_GE(coarse->field.max_error_m, requested.field.max_error_m);
  EXPECT_EQ(coarse->placement.up, requested.placement.up);
}

TEST(CoarseField, IsNotOfferedWhereTheRequestedFieldIsSoonReady) {
  Mesh mesh;
  mesh.triangles.resize(4999);
  recipes::FieldRecipe requested;
  requested.field.resolution = 512;
  EXPECT_FALSE(coarse_recipe({}, mesh, requested));
  mesh.triangles.resize(5000);
  EXPECT_FALSE(coarse_recipe({.resolution = 0}, mesh, requested));
  requested.field.resolution = 191;
  EXPECT_FALSE(coarse_recipe({}, mesh, requested));
  requested.field.resolution = 512;
  requested.storage = recipes::FieldStorage::dense;
  EXPECT_FALSE(coarse_recipe({}, mesh, requested));
}

}  // namespace
}  // namespace palpable::session
