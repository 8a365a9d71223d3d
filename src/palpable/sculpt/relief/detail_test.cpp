// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/detail.hpp"

#include "palpable/sculpt/relief/relief_from_depth.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// A distant wall with fine waves and a near box with finer waves, 1 : 50 of the range.
Raster<float> box_before_wall(int width = 160, int height = 120) {
  Raster<float> n(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool box = x > width / 3 && x < 2 * width / 3 && y > height / 3 && y < 2 * height / 3;
      const double waves = 0.01 * std::sin(0.9 * x) * std::sin(0.7 * y);
      n(x, y) = static_cast<float>(std::clamp((box ? 0.9 : 0.1) + waves, 0.0, 1.0));
    }
  return n;
}

DetailTarget target() {
  DetailTarget t;
  t.pixel_m = 0.1 / 160;
  return t;
}

TEST(MapDetail, GivesEveryOperatorTheFullHeightAndFiniteValues) {
  for (const DetailOperator detail : kDetailOperators) {
    const auto heights = map_detail(box_before_wall(), detail, target(), {}, {});
    ASSERT_TRUE(heights) << name_of(detail);
    const auto [low, high] = std::minmax_element(heights->values().begin(), heights->values().end());
    EXPECT_NEAR(*low, 0.0, 1e-7) << name_of(detail);
    EXPECT_NEAR(*high, 0.015, 1e-6) << name_of(detail);
    EXPECT_GT((*heights)(80, 60), (*heights)(10, 10)) << name_of(detail) << ": near is high";
  }
}

TEST(MapDetail, KeepsTheOrderOfHeightsWhereTheOperatorIsACurve) {
  for (const DetailOperator detail :
       {DetailOperator::linear, DetailOperator::logarithm, DetailOperator::cube_root, DetailOperator::normal,
        DetailOperator::histogram}) {
    Raster<float> ramp(64, 2);
    for (int x = 0; x < 64; ++x) ramp(x, 0) = ramp(x, 1) = static_cast<float>(std::pow(x / 63.0, 3.0));
    const auto heights = map_detail(ramp, detail, target(), {}, {});
    ASSERT_TRUE(heights);
    for (int x = 1; x < 64; ++x) EXPECT_GT((*heights)(x, 0), (*heights)(x - 1, 0)) << name_of(detail) << x;
  }
}

TEST(MapDetail, ReliefShowsDetailThatLinearMappingFlattens) {
  const auto wave_height = [](const Raster<float>& z) {
    float low = 1.0F;
    float high = 0.0F;
    for (int y = 10; y < 30; ++y)
      for (int x = 10; x < 40; ++x) {
        low = std::min(low, z(x, y));
        high = std::max(high, z(x, y));
      }
    return high - low;
  };
  const auto linear = map_detail(box_before_wall(), DetailOperator::linear, target(), {}, {});
  const auto relief = map_detail(box_before_wall(), DetailOperator::relief, target(), {}, {});
  ASSERT_TRUE(linear && relief);
  EXPECT_GT(wave_height(*relief), 3.0F * wave_height(*linear));
}

TEST(MapDetail, ReliefKeepsTheOrderOfAdjacentSteps) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  Raster<float> steps(96, 96);
  for (int y = 0; y < 96; y += 12)
    for (int x = 0; x < 96; x += 12) {
      const float level = std::round(9.0F * unit(random)) / 9.0F;
      for (int b = 0; b < 12; ++b)
        for (int a = 0; a < 12; ++a) steps(x + a, y + b) = level;
    }
  const auto relief = map_detail(steps, DetailOperator::relief, target(), {}, {});
  ASSERT_TRUE(relief);
  int edges = 0;
  int turned = 0;
  for (int y = 6; y < 96; y += 12)
    for (int x = 11; x + 1 < 96; x += 12) {
      const float given = steps(x + 1, y) - steps(x, y);
      if (given == 0.0F) continue;
      ++edges;
      turned += given * ((*relief)(x + 1, y) - (*relief)(x, y)) <= 0.0F ? 1 : 0;
    }
  EXPECT_GT(edges, 30);
  // A low step beside high ones becomes very low, and the iterations end before the last of these converges.
  EXPECT_LE(turned, edges / 30);
}

TEST(MapDetail, IsLevelForALevelPicture) {
  for (const DetailOperator detail : kDetailOperators) {
    const auto heights = map_detail(Raster<float>(40, 30, 0.0F), detail, target(), {}, {});
    ASSERT_TRUE(heights);
    for (const float z : heights->values()) ASSERT_EQ(z, 0.0F) << name_of(detail);
  }
}

TEST(MapDetail, HandlesTheSmallestAndOddSizes) {
  for (const auto& [w, h] : {std::pair{2, 2}, {3, 2}, {2, 37}, {31, 17}}) {
    Raster<float> n(w, h);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) n(x, y) = static_cast<float>(x + y) / static_cast<float>(w + h - 2);
    for (const DetailOperator detail : kDetailOperators) {
      const auto heights = map_detail(n, detail, target(), {}, {});
      ASSERT_TRUE(heights);
      for (const float z : heights->values()) ASSERT_TRUE(std::isfinite(z)) << name_of(detail);
    }
  }
}

TEST(DetailOperators, HaveNamesThatConvertBothWays) {
  for (const DetailOperator detail : kDetailOperators)
    EXPECT_EQ(detail_operator_from(name_of(detail)), detail);
  EXPECT_FALSE(detail_operator_from("no such operator"));
}

TEST(DetailOptions, ChangeTheResultOfTheirOperator) {
  const auto heights = [](DetailOperator detail, const DetailOptions& options) {
    return map_detail(box_before_wall(), detail, target(), options, {});
  };
  const auto differ = [&](DetailOperator detail, const DetailOptions& changed) {
    const auto a = heights(detail, {}), b = heights(detail, changed);
    return a && b && !std::ranges::equal(a->values(), b->values());
  };
  DetailOptions changed;
  changed.relief.gain_scale = 0.2;
  changed.chiu.mean_scale = 0.1;
  changed.ashikhmin.contrast = 0.2;
  changed.bilateral.base_exponent = 0.4;
  changed.histogram.linear_share = 0.9;
  for (const DetailOperator detail : {DetailOperator::relief, DetailOperator::chiu, DetailOperator::ashikhmin,
                                      DetailOperator::bilateral, DetailOperator::histogram})
    EXPECT_TRUE(differ(detail, changed)) << name_of(detail);
  EXPECT_FALSE(differ(DetailOperator::linear, changed));
}

TEST(DetailOptions, AreCheckedAndInRangeByDefault) {
  EXPECT_TRUE(check_ranges(DetailOptions{}));
  DetailOptions wrong;
  wrong.bilateral.range = 0.0;
  const auto heights = map_detail(box_before_wall(), DetailOperator::linear, target(), wrong, {});
  ASSERT_FALSE(heights);
  EXPECT_EQ(heights.error().code, ErrorCode::usage);
  EXPECT_EQ(heights.error().place, "bilateral.range");
}

}  // namespace
}  // namespace palpable::sculpt
