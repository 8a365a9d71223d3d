// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Of every mesh file of the data: what is visible from outside is the surface of its solid.
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/triangles/mesh_orientation.hpp"
#include "palpable/sculpt/triangles/visible_places.hpp"
#include "palpable/sources/solid/mesh_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

constexpr double kSize_m = 0.1;
constexpr double kCell_m = kSize_m / 192;

/// Scaled to the size of a scene.
Mesh scaled(Mesh mesh) {
  const sculpt::Box box = sculpt::bounds_of(mesh);
  const Vec3 size = box.size_m(), middle = 0.5 * (box.least_m + box.most_m);
  const double scale = kSize_m / std::max({size.x, size.y, size.z});
  for (Vec3& v : mesh.vertices_m) v = scale * (v - middle);
  return mesh;
}

TEST(VisibleSurfaces, OfAllMeshFilesAreSurfacesOfTheirSolids) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  const std::set<std::string> endings{".obj", ".glb", ".stl", ".ply"};
  int files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(data) / "mesh")) {
    if (!endings.contains(entry.path().extension().string())) continue;
    const auto file = sources::read_mesh(entry.path());
    ASSERT_TRUE(file) << entry.path();
    std::size_t omitted = 0;
    const Mesh mesh = scaled(sculpt::welded(file->mesh, omitted));
    // The ground of a city, which is left out with a note, is kept here.
    const auto solid = sculpt::solid_from_mesh(mesh, kCell_m, {}, {}, {.ground_facing = 1.0});
    ASSERT_TRUE(solid) << entry.path();
    const auto places = sculpt::visible_places(sculpt::TriangleTree(mesh), {.beside_m = 2.0 * kCell_m}, 1);
    ASSERT_FALSE(places.empty()) << entry.path();
    std::size_t lost = 0, closed = 0;
    sculpt::DistanceSource::Hint hint;
    for (const Vec3 place : places) {
      const double distance_m = solid->distance->at(place, hint).distance_m;
      lost += distance_m > 2.0 * kCell_m ? 1 : 0;
      closed += distance_m < -2.0 * kCell_m ? 1 : 0;
    }
    EXPECT_EQ(lost, 0U) << entry.path();
    // Openings that are closed, such as the attic of a porch without a ceiling, show what is behind them.
    constexpr double kMostClosed = 0.01;
    EXPECT_LE(static_cast<double>(closed), kMostClosed * static_cast<double>(places.size())) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace palpable::cli
