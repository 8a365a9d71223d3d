// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include "palpable/vision/motion/depth/video_depth.hpp"

#include <cmath>
#include <random>

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

constexpr SweptPlanes kFacing[] = {{0.6, 2.0}}, kNoRange[] = {{2.0, 0.6}}, kFromZero[] = {{0.0, 1.0}};
// Parallel to the slanted plane.
const SweptPlanes kParallel[] = {{0.6, 2.0, unit({-kSlope, 0, 1})}};

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

// The picture with a small part of its contrast, and noise.
Raster<Rgb8> faint(const Raster<Rgb8>& picture, std::mt19937& random) {
  std::normal_distribution<double> noise(0, 3);
  const auto level = [&](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::lround(127 + 0.06 * (c - 127) + noise(random)));
  };
  Raster<Rgb8> out(picture.width(), picture.height());
  for (std::size_t i = 0; i < picture.count(); ++i) {
    const Rgb8 p = picture.values()[i];
    out.values()[i] = {level(p.r), level(p.g), level(p.b)};
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
  // Of the pixels in the middle of here_'s map, those whose error is less than a share of their depth.
  double share_within(const DepthMap& map, double tolerance) const {
    int good = 0, all = 0;
    for (int y = 40; y < 140; ++y)
      for (int x = 40; x < 200; ++x, ++all) {
        const double truth = true_depth(here_, x, y);
        good += std::abs(static_cast<double>(map.depth_m(x, y)) - truth) < tolerance * truth ? 1 : 0;
      }
    return static_cast<double>(good) / all;
  }

  CameraPose here_ = moved(0, 0), right_ = moved(0.15, 0), up_ = moved(0, -0.15), left_ = moved(-0.15, 0.02);
  Raster<Rgb8> here_picture_ = picture_from(here_), right_picture_ = picture_from(right_),
               up_picture_ = picture_from(up_), left_picture_ = picture_from(left_);
};

TEST_F(MultiViewDepth, OfASlantedPlaneIsWithinOnePercent) {
  const PosedFrame others[] = {{&right_picture_, right_}, {&up_picture_, up_}, {&left_picture_, left_}};
  const auto depth = multi_view_depth({&here_picture_, here_}, others, kCamera, kFacing, {}, {});
  ASSERT_TRUE(depth);
  EXPECT_GT(share_within(*depth, 0.01), 0.95);
}

TEST_F(MultiViewDepth, OfASlantedPlaneWithFaintTextureIsBetterOverPlanesParallelToIt) {
  std::mt19937 random(3);
  const auto here = faint(here_picture_, random), right = faint(right_picture_, random),
             up = faint(up_picture_, random), left = faint(left_picture_, random);
  const PosedFrame others[] = {{&right, right_}, {&up, up_}, {&left, left_}};
  const auto facing = multi_view_depth({&here, here_}, others, kCamera, kFacing, {}, {});
  const auto parallel = multi_view_depth({&here, here_}, others, kCamera, kParallel, {}, {});
  const SweptPlanes two[] = {kFacing[0], kParallel[0]};
  const auto both = multi_view_depth({&here, here_}, others, kCamera, two, {}, {});
  ASSERT_TRUE(facing && parallel && both);
  EXPECT_GT(share_within(*parallel, 0.01), share_within(*facing, 0.01) + 0.1);
  EXPECT_GT(share_within(*both, 0.01), share_within(*facing, 0.01) + 0.05);
}

TEST_F(MultiViewDepth, NeedsPlanesThatAllLinesOfSightMeet) {
  const PosedFrame others[] = {{&right_picture_, right_}};
  const SweptPlanes edge_on[] = {{0.6, 2.0, unit({1, 0, 0.1})}};
  EXPECT_FALSE(multi_view_depth({&here_picture_, here_}, others, kCamera, edge_on, {}, {}));
  EXPECT_FALSE(multi_view_depth({&here_picture_, here_}, others, kCamera, {}, {}, {}));
}

// The normal lies across the view, so that half of the lines of sight would meet such planes behind the
// camera.
TEST_F(MultiViewDepth, OfAVideoTurnsFavouredPlanesUntilAllLinesOfSightMeetThem) {
  const Raster<Rgb8>* const pictures[] = {&here_picture_, &right_picture_, &up_picture_, &left_picture_};
  CameraMotion motion{kCamera, {here_, right_, up_, left_}, {}, 0};
  for (int x = 10; x < kCamera.width; x += 20)
    for (int y = 10; y < kCamera.height; y += 20) motion.points.push_back({{on_plane(here_, x, y)}, 0});
  VideoDepthOptions options;
  options.favoured_normal = {1, 0, 0};
  const auto maps = depth_of_video(pictures, motion, kCamera, options, {});
  ASSERT_TRUE(maps) << maps.error().message;
  EXPECT_GT(share_within(maps->front().map.depth, 0.01), 0.8);
}

TEST_F(MultiViewDepth, NeedsAnotherFrameAndASpan) {
  const PosedFrame others[] = {{&right_picture_, right_}};
  EXPECT_FALSE(multi_view_depth({&here_picture_, here_}, {}, kCamera, kFacing, {}, {}));
  EXPECT_FALSE(multi_view_depth({&here_picture_, here_}, others, kCamera, kNoRange, {}, {}));
  EXPECT_FALSE(multi_view_depth({&here_picture_, here_}, others, kCamera, kFromZero, {}, {}));
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
