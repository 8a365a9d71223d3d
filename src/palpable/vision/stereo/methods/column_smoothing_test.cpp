// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/column_smoothing.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

struct Surface {
  Raster<Rgb8> picture{20, 40, Rgb8{90, 90, 90}};
  Raster<std::uint8_t> trusted{20, 40, 1};
  Raster<float> disparity{20, 40, 5.0F};

  void smooth() { smooth_columns(picture, trusted, {}, disparity, {}); }
};

TEST(ColumnSmoothing, RemovesAStreak) {
  Surface s;
  for (int x = 4; x < 12; ++x) s.disparity(x, 20) = 11.0F;
  s.smooth();
  for (const float d : s.disparity.values()) EXPECT_NEAR(d, 5.0F, 1e-5F);
}

TEST(ColumnSmoothing, KeepsAnEdgeOfThePictureAndOfTheSurface) {
  Surface s;
  for (int y = 20; y < 40; ++y)
    for (int x = 0; x < 20; ++x) {
      s.picture(x, y) = {200, 200, 200};
      s.disparity(x, y) = 11.0F;
    }
  const Raster<float> before = s.disparity;
  s.smooth();
  EXPECT_EQ(s.disparity, before);
}

TEST(ColumnSmoothing, KeepsASlopeDownThePicture) {
  Surface s;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 20; ++x) s.disparity(x, y) = 3.0F + 0.05F * static_cast<float>(y);
  const Raster<float> before = s.disparity;
  s.smooth();
  EXPECT_EQ(s.disparity, before);
}

}  // namespace
}  // namespace palpable::vision
