// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/stereo_rectification_options.hpp"

#include "palpable/vision/rectification/chessboard_calibration.hpp"
#include "palpable/vision/rectification/plane_rectification.hpp"

#include <set>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

template <class Options>
void expect_described() {
  EXPECT_TRUE(check_ranges(Options{}));
  Options options;
  std::set<std::string> names;
  for (const Parameter& p : parameters_of(options)) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_FALSE(p.meaning.empty()) << p.name;
    EXPECT_LT(p.range.least, p.range.most) << p.name;
    EXPECT_FALSE(set_parameter(p, p.range.most + 1.0)) << p.name;
  }
}

TEST(RectificationOptions, AreDescribedAndAcceptTheirDefaults) {
  expect_described<StereoRectificationOptions>();
  expect_described<PlaneRectificationOptions>();
  expect_described<PlaneTiltOptions>();
  expect_described<ChessboardOptions>();
}

}  // namespace
}  // namespace palpable::vision
