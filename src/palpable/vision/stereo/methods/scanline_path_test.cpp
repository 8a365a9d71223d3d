// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/scanline_path.hpp"

#include "palpable/vision/stereo/cost/cross_window.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 60;
constexpr int kDisparities = 12;
constexpr int kStride = 64;

/// A row's path through costs that are 0 at the true disparity of each column and 40 elsewhere.
struct Row {
  std::vector<float> disparity_px = std::vector<float>(kWidth);
  std::vector<std::uint8_t> occluded = std::vector<std::uint8_t>(kWidth);

  /// `truth(x)`: the true disparity; -1 where no disparity matches.
  template <class Truth>
  explicit Row(const Truth& truth) {
    std::vector<std::uint16_t> costs(kWidth * kStride, 40 * kMeanCostUnit);
    for (int x = 0; x < kWidth; ++x) {
      if (truth(x) >= 0) costs[static_cast<std::size_t>(x * kStride + truth(x))] = 0;
      for (int d = kDisparities; d < kStride; ++d) costs[static_cast<std::size_t>(x * kStride + d)] = 60000;
    }
    const std::vector<std::uint8_t> grey(kWidth, 100);
    ScanlinePath path(kWidth, kDisparities, kStride, {});
    path.find(costs, grey, disparity_px, occluded);
  }
};

TEST(ScanlinePath, FollowsASurface) {
  const Row row([](int) { return 5; });
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_EQ(row.disparity_px[static_cast<std::size_t>(x)], 5.0F) << x;
    EXPECT_EQ(row.occluded[static_cast<std::size_t>(x)], 0) << x;
  }
}

TEST(ScanlinePath, FillsTheOcclusionBesideANearerSurfaceFromTheBackground) {
  // A board at 9 px from column 30 on before a wall at 3 px: six columns of the wall are hidden at its left.
  const Row row([](int x) { return x < 24 ? 3 : x < 30 ? -1 : 9; });
  for (int x = 0; x < kWidth; ++x) {
    const auto i = static_cast<std::size_t>(x);
    EXPECT_EQ(row.disparity_px[i], x < 30 ? 3.0F : 9.0F) << x;
    EXPECT_EQ(row.occluded[i], x >= 24 && x < 30 ? 1 : 0) << x;
  }
}

TEST(ScanlinePath, JumpsDownBehindASurface) {
  const Row row([](int x) { return x < 30 ? 9 : 3; });
  for (int x = 0; x < kWidth; ++x)
    EXPECT_EQ(row.disparity_px[static_cast<std::size_t>(x)], x < 30 ? 9.0F : 3.0F) << x;
}

TEST(ScanlinePath, IgnoresASinglePixelThatMatchesElsewhere) {
  const Row row([](int x) { return x == 30 ? 8 : 5; });
  EXPECT_EQ(row.disparity_px[30], 5.0F);
}

}  // namespace
}  // namespace palpable::vision
