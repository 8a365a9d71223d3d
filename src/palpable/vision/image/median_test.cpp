// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/median.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(Median, IsTheMiddleOfNineAndKeepsTheBorder) {
  Raster<float> values(17, 9);
  for (std::size_t i = 0; i < values.count(); ++i) values.values()[i] = static_cast<float>(i * 7919 % 101);
  const Raster<float> medians = median_3x3(values, {});
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 17; ++x) {
      if (x == 0 || y == 0 || x == 16 || y == 8) {
        EXPECT_EQ(medians(x, y), values(x, y));
        continue;
      }
      std::vector<float> nine;
      for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u) nine.push_back(values(x + u, y + v));
      std::sort(nine.begin(), nine.end());
      EXPECT_EQ(medians(x, y), nine[4]) << x << ' ' << y;
    }
}

}  // namespace
}  // namespace palpable::vision
