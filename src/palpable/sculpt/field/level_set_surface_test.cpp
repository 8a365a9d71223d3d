// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/level_set_surface.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// Two balls of radius 19 and 5 around (0, 0, 0) and (40, 0, 0), in blocks that their surfaces pass.
LevelSet balls() {
  LevelSet set;
  set.background = 3.0F;
  const auto distance = [](Vec3 p) { return std::min(norm(p) - 19.0, norm(p - Vec3{40.0, 0.0, 0.0}) - 5.0); };
  for (int x = -24; x < 56; x += 8)
    for (int y = -24; y < 24; y += 8)
      for (int z = -24; z < 24; z += 8) {
        LevelSet::Block block{{x, y, z}, {}};
        bool near = false;
        for (int i = 0; i < 512; ++i) {
          const double d = distance({x + 1.0 * (i / 64), y + 1.0 * (i / 8 % 8), z + 1.0 * (i % 8)});
          near = near || std::abs(d) < 3.0;
          block.values[static_cast<std::size_t>(i)] = static_cast<float>(std::clamp(d, -3.0, 3.0));
        }
        if (near) set.blocks.push_back(block);
      }
  return set;
}

void expect_balls(const LevelSet& set) {
  const auto mesh = surface_of_level_set(set, Work{});
  ASSERT_TRUE(mesh) << mesh.error().sentence();
  EXPECT_TRUE(is_watertight(*mesh));
  double volume = 0.0;
  for (const auto& t : mesh->triangles)
    volume += dot(mesh->vertices_m[t[0]], cross(mesh->vertices_m[t[1]], mesh->vertices_m[t[2]])) / 6.0;
  const double voxel_m3 = std::abs(dot(set.steps_m[0], cross(set.steps_m[1], set.steps_m[2])));
  EXPECT_NEAR(volume / voxel_m3, 4.18879 * (6859.0 + 125.0), 150.0);
}

TEST(LevelSetSurface, IsClosedAndHoldsTheVolumeOfAllParts) {
  LevelSet set = balls();
  set.steps_m = {Vec3{0.001, 0.0, 0.0}, Vec3{0.0, 0.001, 0.0}, Vec3{0.0, 0.0, 0.001}};
  expect_balls(set);
}

TEST(LevelSetSurface, FacesOutwardsAlsoInAMirroredGrid) {
  LevelSet set = balls();
  set.origin_m = {0.1, -0.2, 0.3};
  set.steps_m = {Vec3{0.0, 0.002, 0.0}, Vec3{0.001, 0.0, 0.0}, Vec3{0.0, 0.0, 0.001}};
  expect_balls(set);
}

TEST(LevelSetSurface, RefusesOneWithoutASurfaceAndOneThatIsTooLong) {
  LevelSet set = balls();
  set.steps_m = {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};
  LevelSet far = set;
  far.blocks.front().corner[0] = 1 << 24;
  EXPECT_FALSE(surface_of_level_set(far, Work{}));
  for (auto& block : set.blocks)
    for (float& v : block.values) v = std::abs(v);
  EXPECT_FALSE(surface_of_level_set(set, Work{}));
  EXPECT_FALSE(surface_of_level_set(LevelSet{}, Work{}));
}

}  // namespace
}  // namespace palpable::sculpt
