// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_channels.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(EdgeChannels, OfColourAreCielab) {
  // sRGB, and its L, a, b under D65 (CIE 15:2004), to the precision of the standard's constants.
  const std::array<std::array<float, 6>, 6> known{{{1.0F, 1.0F, 1.0F, 100.0F, 0.0F, 0.0F},
                                                   {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F},
                                                   {1.0F, 0.0F, 0.0F, 53.24F, 80.09F, 67.20F},
                                                   {0.0F, 1.0F, 0.0F, 87.74F, -86.18F, 83.18F},
                                                   {0.0F, 0.0F, 1.0F, 32.30F, 79.19F, -107.86F},
                                                   {0.02F, 0.02F, 0.02F, 1.40F, 0.0F, 0.0F}}};
  Image image{static_cast<int>(known.size()), 1, 3, 8, {}};
  for (const auto& colour : known)
    image.samples.insert(image.samples.end(), colour.begin(), colour.begin() + 3);
  const auto channels = edge_channels(image, {}, {});
  ASSERT_EQ(channels.size(), 3U);
  for (std::size_t i = 0; i < known.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(100.0F * channels[c].values(static_cast<int>(i), 0), known[i][3 + c], 0.02F)
          << i << " " << c;
}

TEST(EdgeChannels, OfTransparentPixelsAreWhite) {
  const Image image{2, 1, 2, 8, {0.0F, 0.0F, 0.0F, 0.5F}};
  const auto channels = edge_channels(image, {}, {});
  ASSERT_EQ(channels.size(), 1U);
  EXPECT_FLOAT_EQ(channels[0].values(0, 0), 1.0F);
  EXPECT_FLOAT_EQ(channels[0].values(1, 0), 0.5F);
}

}  // namespace
}  // namespace palpable::vision
