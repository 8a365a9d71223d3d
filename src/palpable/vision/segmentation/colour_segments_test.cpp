// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/colour_segments.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Four areas of one colour each, and a spot of 4 pixels in the first.
Raster<Rgb8> fields() {
  Raster<Rgb8> picture(80, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x)
      picture(x, y) = {static_cast<std::uint8_t>(x < 40 ? 60 : 180), 90,
                       static_cast<std::uint8_t>(y < 30 ? 50 : 200)};
  for (int y = 10; y < 12; ++y)
    for (int x = 10; x < 12; ++x) picture(x, y) = {250, 250, 250};
  return picture;
}

TEST(SegmentByColour, MakesASegmentOfEachFieldAndJoinsSpecksToTheirSurroundings) {
  const auto segments = segment_by_colour(fields(), {});
  ASSERT_TRUE(segments);
  EXPECT_EQ(segments->count, 4);
  EXPECT_EQ(segments->of_pixel(10, 10), segments->of_pixel(5, 5));
  EXPECT_NE(segments->of_pixel(5, 5), segments->of_pixel(75, 5));
  EXPECT_NE(segments->of_pixel(5, 5), segments->of_pixel(5, 55));
  SegmentOptions options;
  options.least_pixels = 1;
  EXPECT_GT(segment_by_colour(fields(), options)->count, 4);
}

}  // namespace
}  // namespace palpable::vision
