// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_options.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(ContourOptions, AcceptTheirDefaultsAndRefuseValuesOutOfRange) {
  EXPECT_TRUE(check({}));
  ContourOptions options;
  for (const Parameter& p : parameters_of(options)) {
    const double before = p.get();
    EXPECT_FALSE(set_parameter(p, p.range.most + 1.0)) << p.name;
    EXPECT_FALSE(set_parameter(p, p.range.least - 1.0)) << p.name;
    EXPECT_EQ(p.get(), before) << p.name;
  }
}

TEST(ContourOptions, RefuseAnInvalidThresholdAndPairsThatAreNotAscending) {
  ContourOptions options;
  options.threshold = 1.5;
  EXPECT_FALSE(check(options));
  options.threshold = 0.5;
  EXPECT_TRUE(check(options));
  options.lines.corners.near_px = 12.0;
  EXPECT_FALSE(check(options));
}

}  // namespace
}  // namespace palpable::vision
