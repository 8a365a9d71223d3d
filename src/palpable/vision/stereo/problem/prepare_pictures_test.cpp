// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/prepare_pictures.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A picture with one half of each of these two levels.
Image halves(float left, float right, int bits) {
  Image image{20, 20, 1, bits, std::vector<float>(400)};
  for (std::size_t i = 0; i < 400; ++i) image.samples[i] = i % 20 < 10 ? left : right;
  return image;
}

TEST(PreparedPictures, KeepTheLevelsOfAnEightBitPicture) {
  const Image image = halves(0.2F, 0.8F, 8);
  const MatchInput input = prepare_pictures({image, image, {}}, {});
  EXPECT_EQ(input.left_grey(3, 3), 51);
  EXPECT_EQ(input.right_grey(15, 3), 204);
  EXPECT_EQ(input.left(3, 3).g, 51);
}

TEST(PreparedPictures, StretchADeepPictureToAllLevels) {
  const Image image = halves(0.01F, 0.03F, 16);
  const MatchInput input = prepare_pictures({image, image, {}}, {});
  EXPECT_EQ(input.left_grey(3, 3), 0);
  EXPECT_EQ(input.left_grey(15, 3), 255);
}

TEST(PreparedPictures, MatchTheRightPicturesLevelsToTheLeftOnes) {
  Exposure exposure;
  const MatchInput input =
      prepare_pictures({halves(0.2F, 0.8F, 8), halves(0.1F, 0.4F, 8), {}}, {}, &exposure);
  EXPECT_TRUE(exposure.differs);
  EXPECT_EQ(input.right_grey(3, 3), input.left_grey(3, 3));
  EXPECT_EQ(input.right_grey(15, 3), input.left_grey(15, 3));
}

TEST(ShiftedPictures, MoveByWholePixelsAndRepeatTheBorder) {
  Raster<int> picture(4, 1);
  for (int x = 0; x < 4; ++x) picture(x, 0) = x;
  const Raster<int> right = shifted(picture, 2), left = shifted(picture, -1);
  EXPECT_EQ(right(0, 0), 0);
  EXPECT_EQ(right(3, 0), 1);
  EXPECT_EQ(left(0, 0), 1);
  EXPECT_EQ(left(3, 0), 3);
}

}  // namespace
}  // namespace palpable::vision
