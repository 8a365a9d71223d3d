// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/exposure_match.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A picture with every level from `low` to `high` equally often.
Image ramp(float low, float high) {
  Image image{64, 64, 1, 8, std::vector<float>(64 * 64)};
  for (std::size_t i = 0; i < image.samples.size(); ++i)
    image.samples[i] =
        low + (high - low) * static_cast<float>(i) / static_cast<float>(image.samples.size() - 1);
  return image;
}

TEST(Quantiles, AreThoseOfTheLevels) {
  const Quantiles q = luma_quantiles(ramp(0.2F, 0.7F));
  EXPECT_NEAR(q[0], 0.2F, 1e-6F);
  EXPECT_NEAR(q[255], 0.7F, 1e-3F);
  EXPECT_NEAR(q[51], 0.3F, 1e-3F);
}

TEST(LevelCurve, MapsLevelsByRank) {
  const LevelCurve curve(luma_quantiles(ramp(0.1F, 0.4F)), luma_quantiles(ramp(0.2F, 0.8F)),
                         PreparationOptions{}.clipped_quantiles);
  EXPECT_NEAR(curve(0.1F), 0.2F, 2e-3F);
  EXPECT_NEAR(curve(0.25F), 0.5F, 2e-3F);
  EXPECT_NEAR(curve(0.45F), 0.85F, 2e-3F);  // beyond its end it goes on in parallel
}

TEST(LevelCurve, ClipsLevelsThatTheOtherPictureLost) {
  Image clipped = ramp(0.1F, 1.3F);
  for (float& v : clipped.samples) v = std::min(v, 1.0F);
  const LevelCurve curve(luma_quantiles(clipped), luma_quantiles(ramp(0.05F, 0.65F)),
                         PreparationOptions{}.clipped_quantiles);
  // A quarter of the pixels has the brightest level, so the levels of the darker picture there have no match.
  EXPECT_NEAR(curve.clip(0.64F), 0.5F, 5e-3F);
  EXPECT_EQ(curve.clip(0.3F), 0.3F);
}

TEST(ExposureMatch, FindsADifferenceInExposureAndItsRatio) {
  EXPECT_FALSE(match_exposures(ramp(0.1F, 0.9F), ramp(0.11F, 0.9F), {}).exposure.differs);
  const ExposureMatch match = match_exposures(ramp(0.2F, 0.8F), ramp(0.1F, 0.4F), {});
  EXPECT_TRUE(match.exposure.differs);
  EXPECT_NEAR(match.exposure.brightness_ratio, 0.5, 5e-3);
  EXPECT_NEAR(match.curves[0](0.25F), 0.5F, 3e-3F);
}

}  // namespace
}  // namespace palpable::vision
