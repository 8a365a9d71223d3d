// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/sgm.hpp"

#include "palpable/vision/image/census.hpp"
#include "palpable/vision/stereo/planes/plane_search.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 90;
constexpr int kHeight = 40;
constexpr int kShift = 7;

/// A textured picture whose content is moved `shift` pixels to the left, its levels times `gain`.
MatchView moved_texture(int shift, double gain) {
  Raster<Rgb8> colour(kWidth, kHeight);
  Raster<std::uint8_t> luma(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto level = static_cast<std::uint8_t>(std::lround(255.0 * gain * texture(x + shift, y, 0)));
      colour(x, y) = {level, level, level};
      luma(x, y) = level;
    }
  return match_view(colour, luma, {});
}

TEST(PixelCosts, AreLeastAtTheTrueDisparityAndMostlySoWhereExposuresWereNotLevelled) {
  const MatchView left = moved_texture(0, 1.0);
  for (const auto& [gain, percent] : {std::pair{1.0, 95}, std::pair{0.6, 60}}) {
    CostVolume costs(kWidth, kHeight, 20);
    pixel_costs(left, moved_texture(kShift, gain), costs, {});
    int right = 0;
    const Raster<float> found = least_cost_disparity(costs, {});
    for (int y = 4; y < kHeight - 4; ++y)
      for (int x = 25; x < kWidth - 12; ++x) right += std::abs(found(x, y) - kShift) < 0.75F ? 1 : 0;
    EXPECT_GE(right, (kHeight - 8) * (kWidth - 37) * percent / 100) << gain;
  }
}

TEST(PixelCosts, NeitherFavourNorForbidAMatchOutOfView) {
  CostVolume costs(kWidth, kHeight, 20);
  pixel_costs(moved_texture(0, 1.0), moved_texture(kShift, 1.0), costs, {});
  const std::uint16_t* cost = costs.at(9, 20);
  const std::uint16_t least = *std::min_element(cost, cost + 10);
  const std::uint16_t greatest = *std::max_element(cost, cost + 10);
  for (int d = 10; d < 20; ++d) {
    EXPECT_GT(cost[d], least);
    EXPECT_LT(cost[d], greatest);
  }
}

TEST(PixelCosts, OfAPlainSurfaceDoNotSpeakForTheEdgeBesideIt) {
  // A bright bar that moves by kShift before a plain wall: at the wall's pixels beside the bar the census
  // sees the bar move, but none of the bits that count do.
  const auto bar = [](int shift) {
    Raster<Rgb8> colour(kWidth, kHeight, Rgb8{90, 90, 90});
    Raster<std::uint8_t> luma(kWidth, kHeight, 90);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 40; x < 60; ++x) {
        colour(x - shift, y) = {200, 200, 200};
        luma(x - shift, y) = 200;
      }
    return match_view(colour, luma, {});
  };
  CostVolume costs(kWidth, kHeight, 20);
  pixel_costs(bar(0), bar(kShift), costs, {});
  for (const int beside : {1, 2, 3}) {
    const std::uint16_t* cost = costs.at(59 + beside, kHeight / 2);
    EXPECT_EQ(cost[0], cost[kShift]) << beside;
  }
}

TEST(AveragedCosts, OfAUniformPictureAreThoseOfOnePixel) {
  const MatchView flat{ColourPlanes{Raster<std::uint8_t>(20, 12, 50), Raster<std::uint8_t>(20, 12, 50),
                                    Raster<std::uint8_t>(20, 12, 50)},
                       Raster<std::uint64_t>(20, 12), Raster<std::uint64_t>(20, 12)};
  CostVolume costs(20, 12, 4);
  CostVolume scratch = costs;
  std::fill(costs.cost.begin(), costs.cost.end(), std::uint16_t{4096});
  average_over_crosses(flat.colour, costs, scratch, {});
  for (const std::uint16_t c : costs.cost) EXPECT_EQ(c, 4096);
}

TEST(AggregatedPaths, FindHowFarATextureHasMoved) {
  const MatchView left = moved_texture(0, 1.0);
  const MatchView right = moved_texture(kShift, 1.0);
  CostVolume costs(kWidth, kHeight, 20);
  CostVolume sums = costs;
  pixel_costs(left, right, costs, {});
  aggregate_paths(costs, left.colour, right.colour, sums, {});
  const Raster<float> here = least_cost_disparity(sums, {});
  for (int y = 2; y < kHeight - 2; ++y)
    for (int x = 12; x < kWidth - 12; ++x) EXPECT_NEAR(here(x, y), kShift, 0.75) << x << ' ' << y;
}

TEST(FittedPlanes, AreThePlaneThatTheDisparitiesLieOn) {
  const ColourPlanes colour = moved_texture(0, 0.0).colour;
  PlaneMap map(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      map.disparity(x, y) = 5.0F + 0.1F * static_cast<float>(x) - 0.05F * static_cast<float>(y);
  const Raster<float> all(kWidth, kHeight, 1.0F);
  PlaneMap fitted = map;
  for (int n = 0; n < 5; ++n) fitted = fit_planes(colour, fitted, all, {3, 1}, {});
  for (int y = 6; y < kHeight - 6; ++y)
    for (int x = 6; x < kWidth - 6; ++x) {
      EXPECT_NEAR(fitted.slope_x(x, y), 0.1, 0.004);
      EXPECT_NEAR(fitted.slope_y(x, y), -0.05, 0.004);
      EXPECT_NEAR(fitted.disparity(x, y), map.disparity(x, y), 0.02);
    }
}

TEST(FittedPlanes, DoNotLeanOnWhatIsNotTrusted) {
  const ColourPlanes colour = moved_texture(0, 0.0).colour;
  PlaneMap map(kWidth, kHeight);
  Raster<float> trust(kWidth, kHeight, 1.0F);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      map.disparity(x, y) = x < 45 ? 5.0F : 5.6F;
      if (x >= 45) trust(x, y) = 0.0F;
    }
  const PlaneMap fitted = fit_planes(colour, map, trust, {3, 1}, {});
  EXPECT_NEAR(fitted.disparity(43, 20), 5.0, 1e-4);
  EXPECT_NEAR(fitted.slope_x(43, 20), 0.0, 1e-4);
}

TEST(Planes, OfOneViewAreThoseThatTheOtherSees) {
  // In the left picture d = 6 + 0.1 x + 0.05 y; in the right one, from x - d = 0.9 x - 6 - 0.05 y, with
  // v = x - d: d = (6 + 0.1 v + 0.05 y) / 0.9. The right one is kept mirrored.
  PlaneMap left(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      left.disparity(x, y) = 6.0F + 0.1F * static_cast<float>(x) + 0.05F * static_cast<float>(y);
      left.slope_x(x, y) = 0.1F;
      left.slope_y(x, y) = 0.05F;
    }
  const PlaneMap right = planes_across(left, {});
  const PlaneMap again = planes_across(right, {});
  int seen = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float d = right.disparity(x, y);
      if (std::isnan(d)) continue;
      ++seen;
      const auto v = static_cast<float>(kWidth - 1 - x);
      EXPECT_NEAR(d, (6.0F + 0.1F * v + 0.05F * static_cast<float>(y)) / 0.9F, 1e-4);
      EXPECT_NEAR(right.slope_x(x, y), -0.1 / 0.9, 1e-5);
      EXPECT_NEAR(right.slope_y(x, y), 0.05 / 0.9, 1e-5);
      if (std::isnan(again.disparity(x, y))) continue;
      EXPECT_NEAR(again.disparity(x, y), left.disparity(x, y), 1e-4);
    }
  EXPECT_GT(seen, kWidth * kHeight * 3 / 4);
}

TEST(Planes, AcrossAreTheNearestWhereSeveralFall) {
  // A post at 10 px before a wall at 4 px hides six of the wall's columns.
  PlaneMap left(kWidth, kHeight);
  left.disparity = Raster<float>(kWidth, kHeight, 4.0F);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 40; x < 50; ++x) left.disparity(x, y) = 10.0F;
  const PlaneMap right = planes_across(left, {});
  for (int x = 30; x < 40; ++x) EXPECT_EQ(right.disparity(kWidth - 1 - x, 20), 10.0F);
  EXPECT_EQ(right.disparity(kWidth - 1 - 29, 20), 4.0F);
  EXPECT_TRUE(std::isnan(right.disparity(kWidth - 1 - 45, 20)));
}

TEST(PlaneSearch, FindsASlantFromAFlatStart) {
  // A cost that is least on a plane, and whole-pixel steps to begin with.
  CostVolume costs(kWidth, kHeight, 20);
  const auto truth = [](int x, int y) {
    return 3.0F + 0.12F * static_cast<float>(x) + 0.05F * static_cast<float>(y);
  };
  PlaneMap start(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      start.disparity(x, y) = std::round(truth(x, y));
      for (int d = 0; d < 20; ++d) {
        const float off = static_cast<float>(d) - truth(x, y);
        costs.at(x, y)[d] = static_cast<std::uint16_t>(std::min(4000.0F, 200.0F * off * off));
      }
    }
  const ColourPlanes colour = moved_texture(0, 0.0).colour;
  const Raster<float> all(kWidth, kHeight, 1.0F);
  const Regions whole{Raster<std::int32_t>(kWidth, kHeight, 0), {kWidth * kHeight}};
  PlaneCandidates candidates(kWidth, kHeight);
  PlaneMap map = start;
  for (int round = 0; round < 4; ++round) {
    propose_planes(colour, {map, start, all, whole}, round, candidates, {});
    plane_costs(costs, {}, candidates, {});
    choose_planes(colour, candidates, map, {});
  }
  double error = 0.0;
  double slope_error = 0.0;
  int pixels = 0;
  for (int y = 5; y < kHeight - 5; ++y)
    for (int x = 20; x < kWidth - 5; ++x) {
      error += std::abs(map.disparity(x, y) - truth(x, y));
      slope_error += std::abs(map.slope_x(x, y) - 0.12F) + std::abs(map.slope_y(x, y) - 0.05F);
      ++pixels;
    }
  EXPECT_LT(error / pixels, 0.1);
  EXPECT_LT(slope_error / pixels, 0.05);
}

}  // namespace
}  // namespace palpable::vision
