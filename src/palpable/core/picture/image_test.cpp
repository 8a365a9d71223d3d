// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/image.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(Image, FindsAPixelsChannelsInterleaved) {
  Image image{2, 2, 3, 8, std::vector<float>(12)};
  for (std::size_t i = 0; i < 12; ++i) image.samples[i] = static_cast<float>(i);
  EXPECT_EQ(image.pixel(1, 0)[0], 3.0F);
  EXPECT_EQ(image.pixel(0, 1)[2], 8.0F);
}

TEST(Grey, WeighsRedGreenAndBlueAsRec601) {
  const Image primaries{3, 1, 3, 8, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  const auto luma = grey(primaries);
  EXPECT_FLOAT_EQ(luma(0, 0), 0.299F);
  EXPECT_FLOAT_EQ(luma(1, 0), 0.587F);
  EXPECT_FLOAT_EQ(luma(2, 0), 0.114F);
}

TEST(Grey, KeepsGreyAsItIsAndIgnoresAlpha) {
  EXPECT_FLOAT_EQ(grey(Image{1, 1, 1, 8, {0.7F}})(0, 0), 0.7F);
  EXPECT_FLOAT_EQ(grey(Image{1, 1, 2, 8, {0.7F, 0.0F}})(0, 0), 0.7F);
  EXPECT_FLOAT_EQ(grey(Image{1, 1, 4, 8, {0.5F, 0.5F, 0.5F, 0.0F}})(0, 0), 0.5F);
}

TEST(Grey, KeepsTheScaleOfFloatPictures) {
  EXPECT_FLOAT_EQ(grey(Image{1, 1, 1, 32, {1234.5F}})(0, 0), 1234.5F);
}

TEST(Rgb8, GivesEveryEightBitValueBack) {
  Image ramp{256, 1, 1, 8, {}};
  for (int v = 0; v < 256; ++v) ramp.samples.push_back(static_cast<float>(v) / 255.0F);
  const auto out = rgb8(ramp);
  for (int v = 0; v < 256; ++v) {
    const auto byte = static_cast<std::uint8_t>(v);
    EXPECT_EQ(out(v, 0), (Rgb8{byte, byte, byte}));
  }
}

TEST(Rgb8, ClampsAndTurnsWhatIsNotFiniteBlack) {
  const auto out = rgb8(Image{1, 1, 4, 32, {-3.0F, 7.0F, NAN, 1.0F}});
  EXPECT_EQ(out(0, 0), (Rgb8{0, 255, 0}));
}

TEST(Image, WhoseNumbersDoNotAgreeIsRefused) {
  EXPECT_TRUE(check(Image{2, 1, 3, 8, std::vector<float>(6)}));
  EXPECT_FALSE(check(Image{96, 64, 1, 8, {}}));
  EXPECT_FALSE(check(Image{2, 1, 3, 8, std::vector<float>(5)}));
  EXPECT_FALSE(check(Image{2, 1, 0, 8, {}}));
  EXPECT_FALSE(check(Image{2, 1, 5, 8, std::vector<float>(10)}));
  EXPECT_FALSE(check(Image{0, 1, 1, 8, {}}));
  EXPECT_FALSE(check(Image{-2, -1, 1, 8, std::vector<float>(2)}));
}

}  // namespace
}  // namespace palpable
