// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/skeleton.hpp"

#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

void fill(Mask& mask, int left, int top, int right, int bottom) {
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) mask(x, y) = 1;
}

TEST(Skeleton, ABarGivesOnePathWithFreeEnds) {
  Mask mask(40, 12, 0);
  fill(mask, 3, 4, 36, 6);
  thin_to_lines(mask);
  const Skeleton skeleton = paths_of(mask);
  EXPECT_TRUE(skeleton.nodes.empty());
  ASSERT_EQ(skeleton.paths.size(), 1U);
  EXPECT_FALSE(skeleton.paths[0].closed);
  EXPECT_NEAR(static_cast<double>(skeleton.paths[0].pixels.size()), 32.0, 3.0);
}

TEST(Skeleton, ARingGivesOneClosedPath) {
  Mask mask(40, 40, 0);
  fill(mask, 5, 5, 34, 34);
  for (int y = 8; y <= 31; ++y)
    for (int x = 8; x <= 31; ++x) mask(x, y) = 0;
  thin_to_lines(mask);
  const Skeleton skeleton = paths_of(mask);
  ASSERT_EQ(skeleton.paths.size(), 1U);
  EXPECT_TRUE(skeleton.paths[0].closed);
}

TEST(Skeleton, ACrossGivesFourPathsFromOneNode) {
  Mask mask(41, 41, 0);
  fill(mask, 3, 19, 37, 21);
  fill(mask, 19, 3, 21, 37);
  thin_to_lines(mask);
  const Skeleton skeleton = paths_of(mask);
  ASSERT_EQ(skeleton.nodes.size(), 1U);
  EXPECT_NEAR(skeleton.nodes[0][0], 20.0, 1.0);
  ASSERT_EQ(skeleton.paths.size(), 4U);
  for (const SkeletonPath& path : skeleton.paths) EXPECT_EQ(path.first < 0, path.last >= 0);
}

TEST(Skeleton, ASlantedLineHasNoNode) {
  Mask mask(60, 40, 0);
  for (int x = 5; x < 55; ++x) fill(mask, x, 5 + x / 2, x + 1, 7 + x / 2);
  thin_to_lines(mask);
  EXPECT_TRUE(paths_of(mask).nodes.empty());
  EXPECT_EQ(paths_of(mask).paths.size(), 1U);
}

}  // namespace
}  // namespace palpable::describe
