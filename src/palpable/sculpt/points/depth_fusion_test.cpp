// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/depth_fusion.hpp"

#include "palpable/sculpt/field/level_set_surface.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kRadius_m = 0.05;

/// The noisy depth map of a ball around the origin. There is nothing else in the scene.
DepthMap ball_seen(const Transform<SceneFrame, CameraFrame>& scene_from_camera, double noise_m,
                   unsigned seed) {
  DepthMap map;
  map.camera = Pinhole{200.0, 200.0, 79.5, 59.5, 160, 120};
  map.depth_m = Raster<float>(160, 120, std::numeric_limits<float>::quiet_NaN());
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  const Vec3 eye = scene_from_camera.translation_m;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      const Vec3 way = scene_from_camera.rotate({(x - 79.5) / 200.0, (y - 59.5) / 200.0, 1.0});
      const double a = squared_norm(way), b = dot(way, eye), c = squared_norm(eye) - kRadius_m * kRadius_m;
      const double rest = b * b - a * c;
      if (rest < 0.0) continue;
      map.depth_m(x, y) = static_cast<float>((-b - std::sqrt(rest)) / a + noise_m * noise(random));
    }
  return map;
}

/// A camera 0.2 m from the middle, directed at it, rotated about y.
Transform<SceneFrame, CameraFrame> camera_at(double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  Transform<SceneFrame, CameraFrame> t;
  t.rotation = {c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c};
  t.translation_m = -0.2 * t.rotate({0.0, 0.0, 1.0});
  return t;
}

struct Seen {
  std::vector<DepthMap> maps;
  std::vector<DepthView> views;
};

Seen ball_from(const std::vector<double>& angles_rad, double noise_m) {
  Seen seen;
  for (std::size_t k = 0; k < angles_rad.size(); ++k)
    seen.maps.push_back(ball_seen(camera_at(angles_rad[k]), noise_m, static_cast<unsigned>(k + 1)));
  for (std::size_t k = 0; k < angles_rad.size(); ++k)
    seen.views.push_back({&seen.maps[k], camera_at(angles_rad[k])});
  return seen;
}

/// Root mean square of the fused surface's distance from the ball, where the cameras saw it (|y| small).
std::optional<double> error_m(const Seen& seen, FusionOptions options = {}) {
  options.resolution = 64;
  const auto set = fused_depth(seen.views, options, Work{});
  if (!set) return std::nullopt;
  const auto mesh = surface_of_level_set(*set, Work{});
  if (!mesh) return std::nullopt;
  double sum = 0.0, count = 0.0;
  for (const Vec3 v : mesh->vertices_m) {
    if (std::abs(v.y) > 0.5 * kRadius_m) continue;
    sum += std::pow(norm(v) - kRadius_m, 2.0), count += 1.0;
  }
  return std::sqrt(sum / count);
}

const std::vector<double> kRound{0.0, 0.785, 1.571, 2.356, 3.142, 3.927, 4.712, 5.498};

TEST(FusedDepth, IsTheSolidThatWasSeenFromAllRound) {
  const auto error = error_m(ball_from(kRound, 0.0));
  ASSERT_TRUE(error);
  // A voxel is 1.6 mm.
  EXPECT_LT(*error, 0.0004);
}

TEST(FusedDepth, AveragesNoiseOverTheFrames) {
  std::vector<double> often;
  const std::vector<double> few{0.0, 1.571, 3.142, 4.712};
  for (int k = 0; k < 4; ++k) often.insert(often.end(), few.begin(), few.end());
  const auto once = error_m(ball_from(few, 0.002)), four_times = error_m(ball_from(often, 0.002));
  ASSERT_TRUE(once && four_times);
  EXPECT_LT(*four_times, 0.65 * *once);
}

TEST(FusedDepth, IsSmoothedByItsParameters) {
  FusionOptions rough;
  rough.smoothing.passes = 0;
  const Seen seen = ball_from({0.0, 1.571, 3.142, 4.712}, 0.002);
  const auto smooth_error = error_m(seen), rough_error = error_m(seen, rough);
  ASSERT_TRUE(smooth_error && rough_error);
  EXPECT_GT(*rough_error, 1.1 * *smooth_error);
}

TEST(FusedDepth, FillsBehindWhatOneViewSawAndLeavesTheRestEmpty) {
  const Seen seen = ball_from({0.0}, 0.0);
  FusionOptions options;
  options.resolution = 64;
  const auto set = fused_depth(seen.views, options, Work{});
  ASSERT_TRUE(set);
  const auto mesh = surface_of_level_set(*set, Work{});
  ASSERT_TRUE(mesh);
  const auto solid = solid_from_contour(*mesh);
  ASSERT_TRUE(solid);
  DistanceSource::Hint hint;
  // The camera looks along +z: its box ends at the greatest visible depth, before the middle of the ball.
  EXPECT_LT((*solid)->at({0.0, 0.0, -0.03}, hint).distance_m, 0.0);
  EXPECT_GT((*solid)->at({0.0, 0.0, -0.06}, hint).distance_m, 0.0);
  EXPECT_GT((*solid)->at({0.0, 0.06, -0.03}, hint).distance_m, 0.0);
  EXPECT_GT((*solid)->at({0.0, 0.0, 0.03}, hint).distance_m, 0.0);
}

TEST(FusedDepth, FillsWhatNobodySawBelowASurfaceIfAsked) {
  // From above, and by two cameras that see nothing: what is in the ball is behind it for one of three.
  Seen seen = ball_from({3.1415927, 1.5707963, 1.5707963}, 0.0);
  for (const std::size_t k : {1U, 2U})
    for (float& z : seen.maps[k].depth_m.values()) z = std::numeric_limits<float>::quiet_NaN();
  const auto distance_m = [&](Unseen unseen, Vec3 p) {
    FusionOptions options;
    options.resolution = 64;
    options.unseen = unseen;
    const auto set = fused_depth(seen.views, options, Work{});
    const auto solid = solid_from_contour(*surface_of_level_set(*set, Work{}));
    DistanceSource::Hint hint;
    return (*solid)->at(p, hint).distance_m;
  };
  const Vec3 under{0.0, 0.0, 0.015}, above{0.0, 0.0, 0.055}, beside{0.048, 0.0, 0.04};
  EXPECT_GT(distance_m(Unseen::empty, under), 0.0);
  EXPECT_LT(distance_m(Unseen::solid_below_surfaces, under), 0.0);
  for (const Vec3& p : {above, beside}) EXPECT_GT(distance_m(Unseen::solid_below_surfaces, p), 0.0);
}

TEST(FusedDepth, OfAWallThatIsSeenLevelDoesNotFillTheRoomBehindIt) {
  // Three cameras look level, and three steeply down, along y at a wall that ends before them at y = 0; one
  // pixel at the side shows how deep the room is.
  const auto distance_m = [](double fall) {
    const double n = std::hypot(1.0, fall), c = 1.0 / n, s = fall / n;
    Transform<SceneFrame, CameraFrame> pose;
    // Camera x along x, its y down, its z along (0, c, -s).
    pose.rotation = {1.0, 0.0, 0.0, 0.0, -s, c, 0.0, -c, -s};
    pose.translation_m = -0.3 * pose.rotate({0.0, 0.0, 1.0});
    DepthMap map{Raster<float>(160, 120, 0.3F), Pinhole{200.0, 200.0, 79.5, 59.5, 160, 120}};
    for (int y = 0; y < 120; ++y)
      for (int x = 140; x < 160; ++x) map.depth_m(x, y) = 0.5F;
    const std::vector<DepthView> views(3, DepthView{&map, pose});
    FusionOptions options;
    options.resolution = 48;
    options.unseen = Unseen::solid_below_surfaces;
    const auto set = fused_depth(views, options, Work{});
    const auto solid = solid_from_contour(*surface_of_level_set(*set, Work{}));
    DistanceSource::Hint hint;
    return (*solid)->at((pose * Point<CameraFrame>{{-0.02, 0.0, 0.42}}).v, hint).distance_m;
  };
  EXPECT_GT(distance_m(0.0), 0.0);
  EXPECT_LT(distance_m(1.0), 0.0);
}

TEST(FusedDepth, IsTheSameForAnyNumberOfThreads) {
  const Seen seen = ball_from(kRound, 0.001);
  FusionOptions options;
  options.resolution = 32;
  Work one, three;
  one.threads = 1;
  three.threads = 3;
  const auto a = fused_depth(seen.views, options, one), b = fused_depth(seen.views, options, three);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->blocks.size(), b->blocks.size());
  for (std::size_t i = 0; i < a->blocks.size(); ++i) {
    ASSERT_EQ(a->blocks[i].corner, b->blocks[i].corner);
    ASSERT_EQ(a->blocks[i].values, b->blocks[i].values);
  }
}

TEST(FusedDepth, RefusesMapsWithoutCameraSizeOrDepth) {
  Seen seen = ball_from({0.0}, 0.0);
  FusionOptions far;
  far.near_m = 10.0;
  EXPECT_FALSE(fused_depth(seen.views, far, Work{}));
  FusionOptions coarse;
  coarse.resolution = 8;
  const auto refused = fused_depth(seen.views, coarse, Work{});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  seen.maps[0].camera->width = 100;
  EXPECT_FALSE(fused_depth(seen.views, {}, Work{}));
  seen.maps[0].camera.reset();
  EXPECT_FALSE(fused_depth(seen.views, {}, Work{}));
}

}  // namespace
}  // namespace palpable::sculpt
