// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_colours.hpp"

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

// A camera 2 units above the origin that looks down, x right; red left of the middle, blue right of it.
VideoReconstruction seen_from_above() {
  VideoReconstruction out;
  VideoReconstruction::Depth view;
  view.map.camera = Pinhole{100, 100, 49.5, 49.5, 100, 100};
  view.map.depth_m = Raster<float>(100, 100, 2.0F);
  view.world_from_camera.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  view.world_from_camera.translation_m = {0, 0, 2};
  view.picture = Raster<Rgb8>(100, 100, Rgb8{200, 0, 0});
  for (int y = 0; y < 100; ++y)
    for (int x = 50; x < 100; ++x) view.picture(x, y) = {0, 0, 200};
  out.depth_maps.push_back(view);
  // The scene is a tenth of the world.
  out.scene_from_world.scale = 0.1;
  return out;
}

// A square on the ground, and one below it that nothing shows.
Mesh two_squares() {
  Mesh out;
  for (const double z : {0.0, -0.5})
    for (const double y : {-0.05, 0.05})
      for (const double x : {-0.05, 0.05}) out.vertices_m.push_back({x, y, z});
  out.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}};
  return out;
}

TEST(ColoursOfVideo, AreThoseOfTheFramesAndGreyWhereNothingWasSeen) {
  const auto colours = colours_of(two_squares(), seen_from_above(), {});
  EXPECT_EQ(colours[0], (Rgb8{200, 0, 0}));
  EXPECT_EQ(colours[1], (Rgb8{0, 0, 200}));
  EXPECT_EQ(colours[4], colours[7]);
  EXPECT_NE(colours[4], colours[0]);
}

TEST(ColoursOfVideo, SpreadToNeighboursThatNoFrameSaw) {
  Mesh mesh = two_squares();
  mesh.triangles.push_back({0, 4, 6});
  mesh.triangles.push_back({0, 4, 5});
  const auto colours = colours_of(mesh, seen_from_above(), {});
  EXPECT_EQ(colours[4], (Rgb8{200, 0, 0}));
}

}  // namespace
}  // namespace palpable::recipes
