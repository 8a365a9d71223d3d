// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/depth_order.hpp"

#include "palpable/sculpt/relief/relief_from_depth.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

Raster<float> ramp(double sign) {
  Raster<float> values(64, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) values(x, y) = static_cast<float>(sign * x);
  return values;
}

TEST(DepthOrder, IsKeptByAnyRisingCurveAndInvertedByAFallingOne) {
  Raster<float> cubed = ramp(1.0);
  for (float& z : cubed.values()) z = std::cbrt(z);
  EXPECT_GT(depth_orders(ramp(1.0), ramp(1.0)).anywhere.kept, 0.999);
  EXPECT_GT(depth_orders(ramp(1.0), cubed).anywhere.kept, 0.999);
  EXPECT_GT(depth_orders(ramp(1.0), ramp(-1.0)).anywhere.inverted, 0.999);
}

TEST(DepthOrder, KnowsTheShareOfPairsThatBecameEqual) {
  // The far half becomes level: of two places x, y uniform in 0 ... 1 that differ by more than a tenth (area
  // 0.81), both are in that half in (0.4)^2 = 0.16.
  Raster<float> levelled = ramp(1.0);
  for (float& z : levelled.values()) z = std::max(z, 32.0F);
  const DepthOrder order = depth_orders(ramp(1.0), levelled).anywhere;
  EXPECT_NEAR(order.equal, 0.16 / 0.81, 0.02);
  EXPECT_NEAR(order.kept + order.inverted + order.equal, 1.0, 1e-12);
  EXPECT_EQ(order.inverted, 0.0);
}

TEST(DepthOrder, OfALevelPictureIsKept) {
  const DepthOrder order = depth_orders(Raster<float>(8, 8, 1.0F), Raster<float>(8, 8, 0.0F)).anywhere;
  EXPECT_EQ(order.pairs, 0U);
  EXPECT_EQ(order.kept, 1.0);
}

TEST(DepthOrder, IsToldApartNearAndFar) {
  // Steps of 8 pixels; each pair of neighbouring steps is exchanged. Far apart that changes little.
  Raster<float> steps(64, 48), exchanged(64, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const int step = x / 8;
      steps(x, y) = static_cast<float>(step);
      exchanged(x, y) = static_cast<float>(step % 2 == 0 ? step + 1 : step - 1);
    }
  const DepthOrders orders = depth_orders(steps, exchanged);
  EXPECT_GT(orders.anywhere.kept, 0.8);
  EXPECT_LT(orders.nearby.kept, 0.55);
  EXPECT_GT(orders.nearby.pairs, 100U);
}

// A wide near board beside narrow slats half as near: the share of the local mean that `chiu` subtracts
// lowers the board below the slats.
DepthMap board() {
  DepthMap map;
  map.depth_m = Raster<float>(160, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) map.depth_m(x, y) = x < 80 ? 1.0F : x % 12 < 6 ? 1.5F : 2.0F;
  return map;
}

TEST(DepthOrder, OfAReliefIsGivenForEachOperator) {
  const auto kept = [](DetailOperator detail, Sense sense) {
    ReliefOptions options;
    options.detail = detail;
    options.sense = sense;
    DepthOrders orders;
    EXPECT_TRUE(relief_from_depth(board(), options, {}, &orders));
    EXPECT_GT(orders.anywhere.pairs, 1000U);
    return orders.anywhere.kept;
  };
  EXPECT_GT(kept(DetailOperator::linear, Sense::raise), 0.99);
  EXPECT_GT(kept(DetailOperator::linear, Sense::engrave), 0.99);
  EXPECT_LT(kept(DetailOperator::chiu, Sense::raise), 0.9);
}

}  // namespace
}  // namespace palpable::sculpt
