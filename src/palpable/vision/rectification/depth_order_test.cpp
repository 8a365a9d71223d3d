// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/depth_order.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(OrderAgreement, CountsOnlyPairsThatDifferClearly) {
  const PointDepths depths{{1.0, 1.1, 5.0, 5.1}, {0.5, 0.5, 0.5, 0.5}};
  EXPECT_DOUBLE_EQ(order_agreement(depths, {20, 10, 40, 30}), 1.0);
  EXPECT_DOUBLE_EQ(order_agreement(depths, {40, 30, 20, 10}), -1.0);
  EXPECT_DOUBLE_EQ(order_agreement(depths, {20, 20, 20, 20}), 0.0);
  EXPECT_DOUBLE_EQ(order_agreement({{1.0, 1.1}, {0.5, 0.5}}, {1, 2}), 0.0);
}

}  // namespace
}  // namespace palpable::vision
