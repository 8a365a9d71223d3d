// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/pair_motion.hpp"

#include "palpable/core/numbers/rank_correlation.hpp"
#include "palpable/vision/rectification/seen_points.hpp"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

std::optional<PairMotion> found_in(const std::vector<SeenPoint>& points) {
  return find_pair_motion(matches_of(points), unknown_camera(kSeenWidth, kSeenHeight), 1.5);
}

/// Rank correlation of the motion's nearness with the true inverse depth.
double rank_of(const PairMotion& motion, const std::vector<SeenPoint>& points) {
  std::vector<double> found, real;
  for (const auto& [match, depth_m] : points) {
    found.push_back(motion.model.nearness(match));
    real.push_back(1.0 / depth_m);
  }
  return rank_correlation(found, real);
}

TEST(PairMotion, FindsTheZoomOfACameraThatWasMovedSideways) {
  for (const double zoom : {0.92, 1.08}) {
    const auto points = seen_points({0.12, 0, 0}, {0.5, -0.5, 1}, zoom);
    const auto motion = found_in(points);
    ASSERT_TRUE(motion);
    EXPECT_NEAR(motion->model.zoom, zoom, 0.01);
    EXPECT_GT(motion->model.direction[0], 0.95);
    EXPECT_GT(motion->beyond_turn, 0.3);
    EXPECT_GT(motion->certainty, 0.9);
    EXPECT_GT(rank_of(*motion, points), 0.95);
  }
}

TEST(PairMotion, OrdersDepthsOfACameraThatMovedForwardOrBackward) {
  for (const double along_m : {0.35, -0.35}) {
    const auto points = seen_points({0.02, 0.03, along_m}, {1, -1, 1});
    const auto motion = found_in(points);
    ASSERT_TRUE(motion);
    EXPECT_GT(motion->model.direction[2] * along_m, 0.3);
    EXPECT_GT(rank_of(*motion, points), 0.9) << along_m;
  }
}

TEST(PairMotion, HasNoParallaxBeyondAZoomOrATurn) {
  for (const double zoom : {1.0, 0.95, 1.1}) {
    const auto motion = found_in(seen_points({0, 0, 0}, {1, 3, 2}, zoom));
    EXPECT_TRUE(!motion || motion->beyond_turn < 0.02) << zoom;
  }
}

TEST(PairMotion, IsUncertainWhereAZoomExplainsNearlyAllOfAMovementForward) {
  const auto motion = found_in(seen_points({0, 0, 0.3}, {0, 0, 0}, 1.0, 4.0, 4.6));
  EXPECT_TRUE(!motion || motion->certainty < 0.75 || motion->beyond_turn < 0.05);
}

TEST(PairMotion, KeepsTheFocalLengthOfAKnownCamera) {
  const auto points = seen_points({0.12, 0.01, 0.024}, {1, -1, 2});
  const SharedCamera camera{kSeenFocal_px, 0.5 * (kSeenWidth - 1), 0.5 * (kSeenHeight - 1), true};
  const auto motion = find_pair_motion(matches_of(points), camera, 1.5);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->model.focal_px, kSeenFocal_px, 1e-3);
  EXPECT_NEAR(motion->model.zoom, 1.0, 1e-6);
  EXPECT_NEAR(motion->model.direction[2], 0.2, 0.05);
}

}  // namespace
}  // namespace palpable::vision
