// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/field_update.hpp"

#include "palpable/models/field/field_leaf.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// Two boxes; the right one can have another height.
Mesh boxes(double height_m) {
  return together(box_mesh({-0.03, -0.01, 0.0}, {-0.01, 0.01, 0.02}),
                  box_mesh({0.01, -0.01, 0.0}, {0.03, 0.01, height_m}));
}

TEST(UpdatedField, FollowsTheChangeAndKeepsTheRestBitByBit) {
  FieldOptions options;
  options.resolution = 128;
  const Mesh low = boxes(0.018), high = boxes(0.02);
  const auto before_solid = solid_from_mesh(low, 1e-4, {}), after_solid = solid_from_mesh(high, 1e-4, {});
  ASSERT_TRUE(before_solid && after_solid);
  const auto before = field_from_source(*before_solid->distance, options, {});
  ASSERT_TRUE(before);
  // All faces of the right box except the floor.
  Mesh changed = together(low, high);
  std::erase_if(changed.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t i) { return changed.vertices_m[i].x < 0.0; }) ||
           std::all_of(t.begin(), t.end(), [&](std::uint32_t i) { return changed.vertices_m[i].z == 0.0; });
  });
  const auto updated = updated_field(*before, *after_solid->distance, {changed, {}}, options, {});
  ASSERT_TRUE(updated) << updated.error().sentence();
  const auto& after = *updated;
  ASSERT_TRUE(after);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Vec3 size = before->grid().size_m();
  const double cell_m = before->cell_m();
  int same = 0, near = 0;
  for (int i = 0; i < 40000; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p = before->grid().origin_m + Vec3{x * size.x, y * size.y, z * size.z};
    DistanceSource::Hint hint;
    const double truth = after_solid->distance->at(p, hint).distance_m;
    const models::FieldSample is = after->sample({p});
    if (truth > -0.003 && truth < 0.001) {
      ASSERT_NEAR(is.distance_m, truth, 0.4 * cell_m);
      ++near;
    }
    // All cells that are nearer to the left box.
    const auto cell = [&](double at, double origin, std::size_t axis) {
      return std::min(static_cast<int>((at - origin) / cell_m), before->grid().cells(axis) - 1);
    };
    const Vec3 origin = before->grid().origin_m;
    const int cx = cell(p.x, origin.x, 0), cy = cell(p.y, origin.y, 1), cz = cell(p.z, origin.z, 2);
    const models::DistanceField::Leaf old_leaf = before->leaf_of(cx, cy, cz);
    if (origin.x + cell_m * (old_leaf.corner[0] + old_leaf.side) > -cell_m) continue;
    const models::DistanceField::Leaf leaf = after->leaf_of(cx, cy, cz);
    ASSERT_EQ(leaf.side, old_leaf.side);
    const std::uint32_t* words = &before->tree().words[old_leaf.words];
    ASSERT_TRUE(
        std::equal(words, words + models::LeafHead{*words}.words(), &after->tree().words[leaf.words]));
    ++same;
  }
  EXPECT_GT(same, 10000);
  EXPECT_GT(near, 2000);
}

TEST(UpdatedField, RefusesASolidThatLeavesItsBox) {
  FieldOptions options;
  options.resolution = 32;
  const auto small = field_from_source(Ball(0.01), options, {});
  ASSERT_TRUE(small);
  const Mesh any = box_mesh({-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02});
  const auto refused = updated_field(*small, Ball(0.02), {any, {}}, options, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::failed);
}

}  // namespace
}  // namespace palpable::sculpt
