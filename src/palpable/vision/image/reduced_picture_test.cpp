// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/reduced_picture.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(ReducedPicture, HasAtMostTheGivenPixelsAndBlockMeans) {
  // 40 x 20 in 200 pixels: 20 x 10, each the mean of 2 x 2.
  Image image{40, 20, 1, 8, std::vector<float>(800)};
  for (std::size_t i = 0; i < 800; ++i) image.samples[i] = static_cast<float>(i % 40) / 40.0F;
  const auto small = reduced(image, 200);
  ASSERT_TRUE(small.has_value());
  EXPECT_EQ(small->width, 20);
  EXPECT_EQ(small->height, 10);
  EXPECT_NEAR(*small->pixel(7, 4), 14.5F / 40.0F, 1e-6F);
}

TEST(ReducedPicture, IsAbsentIfThePictureIsSmallEnough) {
  const Image image{40, 20, 3, 8, std::vector<float>(2400)};
  EXPECT_FALSE(reduced(image, 800).has_value());
}

}  // namespace
}  // namespace palpable::vision
