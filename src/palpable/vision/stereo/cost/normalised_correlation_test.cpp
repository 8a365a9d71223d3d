// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/normalised_correlation.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

Raster<std::uint8_t> pattern(int gain, int offset) {
  Raster<std::uint8_t> grey(9, 9);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x)
      grey(x, y) = static_cast<std::uint8_t>(offset + gain * ((7 * x + 5 * y * y) % 11));
  return grey;
}

TEST(NormalisedCorrelation, IsIndependentOfTheExposure) {
  const CorrelationPicture a(pattern(5, 20), 0.01F), b(pattern(9, 100), 0.01F);
  EXPECT_NEAR(correlation_error(a, b, 4, 4, 4), 0.0F, 1e-4F);
}

TEST(NormalisedCorrelation, OfAnInvertedPictureIsOne) {
  const CorrelationPicture a(pattern(5, 20), 0.01F), b(pattern(-5, 120), 0.01F);
  EXPECT_NEAR(correlation_error(a, b, 4, 4, 4), 1.0F, 1e-4F);
}

TEST(NormalisedCorrelation, OfAPlainPictureIsNeutral) {
  const CorrelationPicture a(pattern(5, 20), 2.0F), b(Raster<std::uint8_t>(9, 9, 90), 2.0F);
  EXPECT_NEAR(correlation_error(a, b, 4, 4, 4), 0.5F, 1e-6F);
}

TEST(NormalisedCorrelation, IsNeutralForNoise) {
  const CorrelationPicture a(pattern(1, 90), 40.0F);
  EXPECT_NEAR(correlation_error(a, a, 4, 4, 4), 0.5F, 0.01F);
}

}  // namespace
}  // namespace palpable::vision
