// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/raster.hpp"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(Raster, IsRowMajorFromTheTopLeft) {
  Raster<int> raster(3, 2);
  std::iota(raster.values().begin(), raster.values().end(), 0);
  EXPECT_EQ(raster(0, 0), 0);
  EXPECT_EQ(raster(2, 0), 2);
  EXPECT_EQ(raster(0, 1), 3);
  EXPECT_EQ(raster.row(1).front(), 3);
  EXPECT_EQ(raster.row(1).size(), 3U);
  EXPECT_EQ(raster.row(1).data(), raster.data() + 3);
}

TEST(Raster, StartsWithItsFill) {
  const Raster<float> raster(4, 5, 2.5F);
  EXPECT_EQ(raster.count(), 20U);
  for (const float v : raster.values()) EXPECT_EQ(v, 2.5F);
}

TEST(Raster, TakesValuesThatExist) {
  std::vector<float> values{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F};
  const float* const memory = values.data();
  const Raster<float> raster(3, 2, std::move(values));
  EXPECT_EQ(raster(2, 0), 3.0F);
  EXPECT_EQ(raster(0, 1), 4.0F);
  EXPECT_EQ(raster.data(), memory) << "without a copy";
}

TEST(Raster, ContainsItsPixelsOnly) {
  const Raster<int> raster(3, 2);
  EXPECT_TRUE(raster.contains(0, 0));
  EXPECT_TRUE(raster.contains(2, 1));
  EXPECT_FALSE(raster.contains(3, 1));
  EXPECT_FALSE(raster.contains(2, 2));
  EXPECT_FALSE(raster.contains(-1, 0));
  EXPECT_FALSE(raster.contains(0, -1));
}

TEST(Raster, IsAValue) {
  Raster<int> a(2, 2, 1);
  const Raster<int> b = a;
  a(1, 1) = 5;
  EXPECT_EQ(b(1, 1), 1);
  EXPECT_NE(a, b);
}

TEST(Raster, MayBeEmptyInOneDirection) {
  EXPECT_TRUE(Raster<int>().empty());
  EXPECT_TRUE(Raster<int>(0, 7).empty());
  EXPECT_EQ(Raster<int>(0, 7).height(), 7);
}

TEST(RasterDeathTest, RefusesANegativeSize) { EXPECT_DEATH(Raster<int>(-1, 3), "width >= 0"); }

TEST(RasterDeathTest, RefusesAnotherNumberOfValues) {
  EXPECT_DEATH(Raster<int>(2, 2, std::vector<int>{1, 2, 3}), "values_.size");
}

}  // namespace
}  // namespace palpable
