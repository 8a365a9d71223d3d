// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The viewer's head in a depth camera's pictures (vision/depth_camera/head_finder.hpp), beside the truth.
#include "palpable/study/world/viewer.hpp"

#include "palpable/vision/depth_camera/head_finder.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

constexpr double kPeriod_s = 1.0 / 30.0;

struct Followed {
  int pictures = 0, found = 0;
  /// Greatest distance from the eyes; and of still ones, root mean square from their mean.
  double worst_m = 0.0, jitter_m = 0.0;
};

Followed follow(Viewer& viewer, const ViewerOptions& options, double begin_s, double end_s) {
  vision::HeadFinder finder;
  Followed followed;
  Vec3 sum;
  double squares = 0.0;
  for (double time_s = begin_s; time_s < end_s; time_s += kPeriod_s, ++followed.pictures) {
    const auto pose = viewer.pose_at(time_s);
    const auto head = finder.find(viewer.depth(pose), {options.camera, options.down_rad});
    if (!head) continue;
    ++followed.found;
    const Vec3 at = head->eyes.v;
    sum += at;
    squares += dot(at, at);
    followed.worst_m = std::max(followed.worst_m, norm(at - viewer.eyes(pose).v));
  }
  const Vec3 mean = sum / std::max(1, followed.found);
  followed.jitter_m = std::sqrt(std::max(0.0, squares / std::max(1, followed.found) - dot(mean, mean)));
  return followed;
}

TEST(HeadFinder, FindsTheHeadOfAStillViewerWithoutTrembling) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const ViewerOptions options{seed};
    Viewer viewer(options);
    const auto followed = follow(viewer, options, 0.0, 2.0);
    EXPECT_EQ(followed.found, followed.pictures) << seed;
    EXPECT_LT(followed.worst_m, 0.025) << seed;
    EXPECT_LT(followed.jitter_m, 0.002) << seed;
  }
}

TEST(HeadFinder, FollowsAMovingHeadBesideRaisedHands) {
  for (const std::uint64_t seed : {4, 5}) {
    const ViewerOptions options{seed};
    Viewer viewer(options);
    const auto followed = follow(viewer, options, 8.0, 13.0);
    EXPECT_GE(followed.found, 0.98 * followed.pictures) << seed;
    // A head that is turned by 11 degrees has its eyes 16 mm aside.
    EXPECT_LT(followed.worst_m, 0.045) << seed;
  }
}

TEST(HeadFinder, AccountsForACameraThatLooksDown) {
  const ViewerOptions options{6, {285.0, 285.0, 159.5, 119.5, 320, 240}, 0.26};
  Viewer viewer(options);
  const auto followed = follow(viewer, options, 0.0, 1.0);
  EXPECT_EQ(followed.found, followed.pictures);
  EXPECT_LT(followed.worst_m, 0.025);
}

TEST(HeadFinder, FindsNoHeadInAnEmptyRoomOrWithoutDepth) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const ViewerOptions options{seed};
    Viewer viewer(options);
    vision::HeadFinder finder;
    if (const auto head = finder.find(viewer.empty_depth(), {options.camera, 0.0}))
      ADD_FAILURE() << seed << ": " << head->eyes.v.x << ' ' << head->eyes.v.y << ' ' << head->eyes.v.z;
    EXPECT_FALSE(finder.find(Raster<float>(320, 240, kUnknownDepth), {options.camera, 0.0}));
  }
  vision::HeadFinder finder;
  EXPECT_FALSE(finder.find(Raster<float>(1, 1, 0.5F), {{1.0, 1.0, 0.0, 0.0, 1, 1}, 0.0}));
}

TEST(HeadFinder, LosesAViewerWhoLeavesAndFindsTheNextOne) {
  const ViewerOptions options{9};
  Viewer viewer(options);
  const vision::DownwardCamera camera{options.camera, 0.0};
  vision::HeadFinder finder;
  EXPECT_TRUE(finder.find(viewer.depth(viewer.pose_at(0.0)), camera));
  EXPECT_FALSE(finder.find(viewer.empty_depth(), camera));
  EXPECT_TRUE(finder.find(viewer.depth(viewer.pose_at(0.0)), camera));
}

}  // namespace
}  // namespace palpable::study
