// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/plane_mask.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(PlaneMask, ExcludesTheFootOfABoxOnThePlane) {
  // A ground that rises by 0.1 px per row, and a box with its foot at row 70 and constant disparity up to row
  // 40.
  const DisparityPlane plane{0.0, 0.1, 10.0};
  Raster<float> disparity(100, 90);
  Raster<Rgb8> picture(100, 90, Rgb8{90, 90, 90});
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 100; ++x) {
      const bool box = x >= 30 && x < 60 && y >= 40 && y < 70;
      disparity(x, y) = static_cast<float>(plane.at(x, box ? 70 : y));
      if (box) picture(x, y) = {200, 60, 40};
    }
  const auto mask =
      plane_mask(merge_regions(picture), disparity, {plane, 0.05}, PlaneDirection::ground, {}, {});
  EXPECT_EQ(mask(10, 10), 255);
  EXPECT_EQ(mask(45, 80), 255);
  EXPECT_EQ(mask(45, 50), 0);
  EXPECT_EQ(mask(45, 66), 0) << "its foot";
}

TEST(Majority, RemovesSpecksAndFillsHoles) {
  Raster<std::uint8_t> mask(20, 20);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 10; ++x) mask(x, y) = 255;
  mask(4, 10) = 0;
  mask(15, 10) = 255;
  const auto out = majority(mask, 2);
  EXPECT_EQ(out(4, 10), 255);
  EXPECT_EQ(out(15, 10), 0);
  EXPECT_EQ(out(2, 2), 255);
}

}  // namespace
}  // namespace palpable::vision
