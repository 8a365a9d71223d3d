// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/pair_sequence.hpp"

#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

StereoPair with_rig(StereoPair pair) {
  pair.rig = StereoRig{{200.0, 200.0, 79.5, 47.5, pair.left.width, pair.left.height}, 0.1, 0.0};
  return pair;
}

/// The share of pixels whose depth is that of the scene's disparity within half a pixel; and of unknown ones.
struct Shares {
  double right = 0.0;
  double unknown = 0.0;
};
Shares shares_of(const Raster<float>& depth_m, const SyntheticScene& scene) {
  Shares shares;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const double z = depth_m(x, y);
      if (std::isfinite(z))
        shares.right += std::abs(0.1 * 200.0 / z - scene.truth(x, y)) < 0.5 ? 1.0 : 0.0;
      else
        shares.unknown += 1.0;
    }
  const double all = scene.width * scene.height;
  return {shares.right / all, shares.unknown / all};
}

TEST(PairSequence, GivesMetricDepthAndLeavesUnknownWhatIsHidden) {
  PairSequence sequence;
  for (int frame = 0; frame < 3; ++frame) {
    const auto depth = sequence.depth(with_rig(render({})), {});
    ASSERT_TRUE(depth) << depth.error().sentence();
    const auto shares = shares_of(depth->depth_m, {});
    EXPECT_GT(shares.right, 0.85) << frame;
    // Eight columns beside the box and some at the border.
    EXPECT_GT(shares.unknown, 0.02) << frame;
    EXPECT_LT(shares.unknown, 0.14) << frame;
  }
}

TEST(PairSequence, FollowsWhatComesNear) {
  PairSequence sequence;
  SyntheticScene scene;
  scene.width = 240;
  Shares last;
  // From 14 to 44 px in 24 pairs, faster than the margin of four pixels in all.
  for (scene.box_px = 14.0; scene.box_px <= 44.0; scene.box_px += 1.25) {
    const auto depth = sequence.depth(with_rig(render(scene)), {});
    ASSERT_TRUE(depth) << depth.error().sentence();
    last = shares_of(depth->depth_m, scene);
  }
  EXPECT_GT(last.right, 0.75);
}

TEST(PairSequence, SeesWithinHalfASecondWhatAppearedFarInFront) {
  PairSequence sequence;
  SyntheticScene scene;
  scene.width = 240;
  scene.box_px = 8.0;
  ASSERT_TRUE(sequence.depth(with_rig(render(scene)), {}));
  scene.box_px = 60.0;
  scene.box_left = 110;
  scene.box_right = 160;
  Shares shares;
  for (int frame = 0; frame < 15; ++frame)
    shares = shares_of(sequence.depth(with_rig(render(scene)), {})->depth_m, scene);
  EXPECT_GT(shares.right, 0.7);
}

TEST(PairSequence, ReducesLargePicturesAndScalesTheirRig) {
  SyntheticScene scene;
  scene.width = 640;
  scene.height = 480;
  scene.ground_px = 20.0;
  scene.box_px = 20.0;
  PairSequence sequence;
  auto pair = with_rig(render(scene));
  const auto depth = sequence.depth(pair, {});
  ASSERT_TRUE(depth) << depth.error().sentence();
  EXPECT_LE(depth->depth_m.count(), 240U * 180U);
  EXPECT_NEAR(depth->depth_m(depth->depth_m.width() / 2, depth->depth_m.height() / 2), 1.0, 0.03);
  EXPECT_NEAR(depth->camera->fx / depth->camera->width, 200.0 / 640.0, 1e-3);
}

TEST(PairSequence, TakesTheLeftPictureForTheRightOneIfTheyAreExchanged) {
  PairSequence sequence;
  auto pair = with_rig(render({}));
  std::swap(pair.left, pair.right);
  for (int frame = 0; frame < 2; ++frame) {
    const auto depth = sequence.depth(pair, {});
    ASSERT_TRUE(depth) << depth.error().sentence();
    EXPECT_TRUE(sequence.exchanged());
    EXPECT_GT(shares_of(depth->depth_m, {}).right, 0.85) << frame;
  }
}

}  // namespace
}  // namespace palpable::vision
