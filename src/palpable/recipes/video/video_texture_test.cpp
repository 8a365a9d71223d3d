// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_texture.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

// A camera 2 units above the scene's origin that looks down, x right, moved sideways. The ground shows
// stripes of 0.02 units, so that each pixel says where it looks.
constexpr double kFocal_px = 200.0;
Rgb8 stripe_at(double x) {
  return {static_cast<std::uint8_t>(60 + 40 * (static_cast<int>(std::floor(x / 0.02)) & 3)), 90, 120};
}
VideoReconstruction::Depth view_from(double x, double gain) {
  VideoReconstruction::Depth view;
  view.map.camera = Pinhole{kFocal_px, kFocal_px, 49.5, 49.5, 100, 100};
  view.map.depth_m = Raster<float>(100, 100, 2.0F);
  view.world_from_camera.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  view.world_from_camera.translation_m = {x, 0, 2};
  view.picture = Raster<Rgb8>(100, 100);
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 100; ++u) {
      const Rgb8 p = stripe_at(x + 2 * (u - 49.5) / kFocal_px);
      view.picture(u, v) = {static_cast<std::uint8_t>(std::lround(gain * p.r)),
                            static_cast<std::uint8_t>(std::lround(gain * p.g)),
                            static_cast<std::uint8_t>(std::lround(gain * p.b))};
    }
  return view;
}

// A strip of triangles on the ground from x = -0.5 to 0.5, wider than one frame shows, and a triangle far
// away.
Mesh strip() {
  Mesh out;
  constexpr int kSquares = 50;
  for (int i = 0; i <= kSquares; ++i)
    for (const double y : {-0.1, 0.1}) out.vertices_m.push_back({-0.5 + i * 0.02, y, 0});
  for (std::uint32_t i = 0; i < kSquares; ++i) {
    const std::uint32_t a = 2 * i;
    out.triangles.push_back({a, a + 2, a + 3});
    out.triangles.push_back({a, a + 3, a + 1});
  }
  out.vertices_m.insert(out.vertices_m.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  out.triangles.push_back({102, 103, 104});
  return out;
}

Rgb8 texel_at(const TexturedMesh& mesh, double u, double v) {
  return mesh.picture(static_cast<int>(std::floor(u * mesh.picture.width())),
                      static_cast<int>(std::floor(v * mesh.picture.height())));
}

class TextureOfVideo : public testing::Test {
 protected:
  VideoReconstruction video(double gain) const {
    VideoReconstruction out;
    out.depth_maps = {view_from(-0.2, 1.0), view_from(0.2, gain)};
    return out;
  }
};

TEST_F(TextureOfVideo, ShowsInTheMiddleOfEachTriangleWhatIsThere) {
  const Mesh given = strip();
  const TexturedMesh made = textured(given, video(1.0), {});
  ASSERT_EQ(made.mesh.triangles.size(), given.triangles.size());
  ASSERT_EQ(made.mesh.picture_places.size(), made.mesh.vertices_m.size());
  ASSERT_EQ(made.normals.size(), made.mesh.vertices_m.size());
  for (std::size_t i = 0; i + 1 < made.mesh.triangles.size(); ++i) {
    double x = 0, u = 0, v = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = made.mesh.triangles[i][k];
      EXPECT_EQ(made.mesh.vertices_m[corner].x, given.vertices_m[given.triangles[i][k]].x);
      x += made.mesh.vertices_m[corner].x / 3;
      u += static_cast<double>(made.mesh.picture_places[corner][0]) / 3;
      v += static_cast<double>(made.mesh.picture_places[corner][1]) / 3;
    }
    // Stripes differ by 40 levels; the common brightness follows from vertices on their borders.
    EXPECT_NEAR(texel_at(made, u, v).r, stripe_at(x).r, 3) << "triangle " << i << " at x = " << x;
  }
}

TEST_F(TextureOfVideo, BringsFramesToOneBrightness) {
  const TexturedMesh made = textured(strip(), video(0.7), {});
  // Blue has no stripes: one level but for the rounding, where the frames alone differ by 36.
  int least = 255, most = 0;
  for (std::size_t i = 0; i + 1 < made.mesh.triangles.size(); ++i)
    for (const std::uint32_t corner : made.mesh.triangles[i]) {
      const auto& place = made.mesh.picture_places[corner];
      const Rgb8 texel = texel_at(made, static_cast<double>(place[0]), static_cast<double>(place[1]));
      least = std::min<int>(least, texel.b), most = std::max<int>(most, texel.b);
    }
  EXPECT_LE(most - least, 18);
}

TEST_F(TextureOfVideo, IsPlainWhereNoFrameShowsTheTriangle) {
  const TexturedMesh made = textured(strip(), video(1.0), {});
  const auto& last = made.mesh.triangles.back();
  const auto& place = made.mesh.picture_places[last[0]];
  EXPECT_EQ(place, made.mesh.picture_places[last[1]]);
  EXPECT_EQ(place, made.mesh.picture_places[last[2]]);
  const Rgb8 texel = texel_at(made, static_cast<double>(place[0]), static_cast<double>(place[1]));
  EXPECT_NEAR(texel.r, 150, 8) << "grey, as colours_of() has it";
  EXPECT_EQ(texel.r, texel.g);
}

TEST_F(TextureOfVideo, KeepsASurfaceThatNoFrameShows) {
  const TexturedMesh made = textured(strip(), {}, {});
  EXPECT_EQ(made.mesh.triangles.size(), strip().triangles.size());
  for (const auto& place : made.mesh.picture_places)
    EXPECT_NEAR(texel_at(made, static_cast<double>(place[0]), static_cast<double>(place[1])).g, 150, 8);
}

}  // namespace
}  // namespace palpable::recipes
