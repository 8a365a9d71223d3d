// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace palpable::vision {
namespace {

constexpr Pinhole kCamera{300, 300, 119.5, 89.5, 240, 180};

// The texture of a slanted plane in its own coordinates.
Rgb8 texture(double u, double v) {
  const auto wave = [](double a) { return static_cast<std::uint8_t>(std::lround(127 + 120 * std::sin(a))); };
  return {wave(61 * u + 3 * std::sin(17 * v)), wave(53 * v + 2 * std::sin(23 * u)),
          wave(37 * u * v + 71 * v)};
}

constexpr double kSlope = 0.3;  // z = 1 + kSlope x

// The intersection of a pixel's ray with the plane, in the world frame.
Vec3 on_plane(const CameraPose& pose, int x, int y) {
  const Vec3 d = pose.rotate({(x - kCamera.cx) / kCamera.fx, (y - kCamera.cy) / kCamera.fy, 1});
  const Vec3 o = pose.translation_m;
  const double t = (1 + kSlope * o.x - o.z) / (d.z - kSlope * d.x);
  return o + t * d;
}

Raster<Rgb8> picture_from(const CameraPose& pose) {
  Raster<Rgb8> out(kCamera.width, kCamera.height);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const Vec3 p = on_plane(pose, x, y);
      out(x, y) = texture(p.x, p.y);
    }
  return out;
}

CameraPose moved(double x, double y) {
  CameraPose pose;
  pose.translation_m = {x, y, 0};
  return pose;
}

double true_depth(const CameraPose& pose, int x, int y) {
  return (pose.inverse() * Point<WorldFrame>{on_plane(pose, x, y)}).v.z;
}

class MultiViewDepth : public testing::Test {
 protected:
  CameraPose here_ = moved(0, 0), right_ = moved(0.15, 0), up_ = moved(0, -0.15), left_ = moved(-0.15, 0.02);
  Raster<Rgb8> here_picture_ = picture_from(here_), right_picture_ = picture_from(right_),
               up_picture_ = picture_from(up_), left_picture_ = picture_from(left_);
};

TEST_F(MultiViewDepth, OfASlantedPlaneIsWithinOnePercent) {
  const PosedFrame others[] = {{&right_picture_, right_}, {&up_picture_, up_}, {&left_picture_, left_}};
  const auto depth = multi_view_depth({&here_picture_, here_}, others, kCamera, {0.6, 2.0}, {}, {});
  ASSERT_TRUE(depth);
  int good = 0, all = 0;
  for (int y = 40; y < 140; ++y)
    for (int x = 40; x < 200; ++x, ++all)
      if (std::abs(depth->depth_m(x, y) - true_depth(here_, x, y)) < 0.01 * true_depth(here_, x, y)) ++good;
  EXPECT_GT(good, 0.95 * all);
}

TEST_F(MultiViewDepth, NeedsAnotherFrameAndASpan) {
  const PosedFrame others[] = {{&right_picture_, right_}};
  EXPECT_FALSE(multi_view_depth({&here_picture_, here_}, {}, kCamera, {0.6, 2.0}, {}, {}));
  EXPECT_FALSE(multi_view_depth({&here_picture_, here_}, others, kCamera, {2.0, 0.6}, {}, {}));
  EXPECT_FALSE(multi_view_depth({&here_picture_, here_}, others, kCamera, {0.0, 1.0}, {}, {}));
}

PosedDepthMap exact_map(const CameraPose& pose) {
  PosedDepthMap out{{Raster<float>(kCamera.width, kCamera.height), kCamera}, pose};
  for (int y = 0; y < kCamera.height; ++y)
    for (int x = 0; x < kCamera.width; ++x)
      out.depth.depth_m(x, y) = static_cast<float>(true_depth(pose, x, y));
  return out;
}

TEST_F(MultiViewDepth, ConsistencyKeepsAgreeingDepthsOnly) {
  std::vector<PosedDepthMap> maps{exact_map(here_), exact_map(right_), exact_map(up_)};
  maps[0].depth.depth_m(80, 60) *= 1.05F;
  const auto consistent = consistent_depth(maps, {}, {});
  ASSERT_TRUE(consistent);
  EXPECT_TRUE(std::isnan((*consistent)[0].depth.depth_m(80, 60)));
  EXPECT_NEAR((*consistent)[0].depth.depth_m(70, 50), true_depth(here_, 70, 50), 0.003);
}

TEST_F(MultiViewDepth, ConsistencyNeedsTheGivenNumberOfMaps) {
  const std::vector<PosedDepthMap> maps{exact_map(here_), exact_map(right_)};
  const auto strict =
      consistent_depth(maps, {.tolerance = 0.01, .least_agreeing = 2, .least_uncontested = 2}, {});
  ASSERT_TRUE(strict);
  EXPECT_TRUE(std::isnan((*strict)[0].depth.depth_m(70, 50)));
}

}  // namespace
}  // namespace palpable::vision
