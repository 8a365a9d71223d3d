// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/segment_planes.hpp"

#include "palpable/vision/stereo/problem/prepare_pictures.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(SegmentPlanes, LieOnTheSurfacesOfAPair) {
  const SyntheticScene scene = slanted_scene();
  MatchInput input = prepare_pictures(render(scene), {});
  input.disparities = 24;
  const auto found = find_segment_planes(input, {}, {});
  ASSERT_TRUE(found.has_value());
  int good = 0, all = 0;
  for (int y = 4; y < scene.height - 4; ++y)
    for (int x = 30; x < scene.width - 4; ++x) {
      if (!scene.in_box(x, y) && scene.in_box(x - scene.truth(x, y) + scene.box_px, y)) continue;
      ++all;
      good += std::abs(found->at(x, y).at(x, y) - scene.truth(x, y)) <= 1.0 ? 1 : 0;
    }
  EXPECT_GT(good, all * 9 / 10);
}

TEST(SegmentPlanes, AreOneForAPairWithoutTexture) {
  MatchInput input;
  input.left = input.right = Raster<Rgb8>(40, 30, Rgb8{90, 90, 90});
  input.left_grey = input.right_grey = Raster<std::uint8_t>(40, 30, 90);
  input.disparities = 8;
  const auto found = find_segment_planes(input, {}, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->segments.count, 1);
  for (const std::size_t plane : found->plane_of) EXPECT_LT(plane, found->planes.size());
}

}  // namespace
}  // namespace palpable::vision
