// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Random houses whose walls are open below and above: what is visible from outside is the solid's surface.
// `--gtest_random_seed=N` makes other scenes.
#include "palpable/sculpt/solid/house_scenes.hpp"

#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/triangles/visible_places.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// The greatest distance of a visible place from the surface. Places behind the hull are seen through a gap.
double farthest_visible_m(const HouseScene& scene, const MeshSolid& solid, unsigned seed) {
  double worst_m = 0.0;
  DistanceSource::Hint hint;
  for (const Vec3 p : visible_places(TriangleTree(scene.mesh), {.beside_m = 2.0 * kCell_m}, seed)) {
    if (scene.hull_distance(p) < -scene.niches_m - 2.0 * kCell_m) continue;
    worst_m = std::max(worst_m, std::abs(solid.distance->at(p, hint).distance_m));
  }
  return worst_m;
}

TEST(HouseScenes, AreSolidWithinTheirHullsAndShowTheirVisibleSurfaces) {
  const auto seed = 20261123U + 1000U * static_cast<unsigned>(GTEST_FLAG_GET(random_seed));
  std::mt19937_64 random(seed);
  constexpr unsigned kScenes = 50;
  for (unsigned k = 0; k < kScenes; ++k) {
    HouseScene scene = HouseMaker(seed + k).scene();
    if (k % 2 == 1)
      for (Vec3& v : scene.mesh.vertices_m)
        v = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    const auto solid = solid_from_mesh(scene.mesh, kCell_m, {}, {}, kTwoCellWalls);
    ASSERT_TRUE(solid) << seed + k << ": " << scene.words;
    EXPECT_LT(farthest_visible_m(scene, *solid, seed + k), 2.0 * kCell_m) << seed + k << ": " << scene.words;
    const Box box = bounds_of(scene.mesh);
    std::uniform_real_distribution<double> share(-0.1, 1.1);
    DistanceSource::Hint hint;
    int wrong_air = 0, wrong_solid = 0;
    constexpr int kPlaces = 3000;
    for (int i = 0; i < kPlaces; ++i) {
      const Vec3 size = box.size_m();
      const Vec3 p =
          box.least_m + Vec3{size.x * share(random), size.y * share(random), size.z * share(random)};
      const double hull_m = scene.hull_distance(p), felt_m = solid->distance->at(p, hint).distance_m;
      wrong_solid += hull_m > 2.0 * kCell_m && felt_m < 0.0 ? 1 : 0;
      wrong_air += hull_m < -scene.niches_m - 2.0 * kCell_m && felt_m > 0.0 ? 1 : 0;
    }
    EXPECT_EQ(wrong_solid, 0) << seed + k << ": " << scene.words;
    EXPECT_EQ(wrong_air, 0) << seed + k << ": " << scene.words;
  }
}

}  // namespace
}  // namespace palpable::sculpt
