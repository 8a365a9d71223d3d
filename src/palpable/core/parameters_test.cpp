// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/parameters.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable {
namespace {

struct Window {
  int reach_px = 3;
};
std::vector<Parameter> parameters_of(Window& o) {
  return {{"reach_px", &o.reach_px, {0, 9}, "px", "Pixels to each side"}};
}

struct Options {
  float weight = 0.5F;
  Window window;
};
std::vector<Parameter> parameters_of(Options& o) {
  std::vector<Parameter> all{{"weight", &o.weight, {0.0, 1.0}, "", "Weight of the smooth surface"}};
  append_parameters(all, "window", parameters_of(o.window));
  return all;
}

TEST(Parameters, AreNamedByTheirPathAndHoldTheFieldsValues) {
  Options options;
  const auto all = parameters_of(options);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].name, "weight");
  EXPECT_EQ(all[0].get(), 0.5);
  EXPECT_EQ(all[1].name, "window.reach_px");
  EXPECT_EQ(all[1].get(), 3.0);
}

TEST(Parameters, SetTheFieldThatTheyDescribe) {
  Options options;
  const auto all = parameters_of(options);
  EXPECT_TRUE(set_parameter(all[0], 0.25).has_value());
  EXPECT_TRUE(set_parameter(all[1], 9.0).has_value());
  EXPECT_EQ(options.weight, 0.25F);
  EXPECT_EQ(options.window.reach_px, 9);
}

TEST(Parameters, RefuseValuesOutOfRangeAndNameTheParameter) {
  Options options;
  const auto all = parameters_of(options);
  const auto refused = set_parameter(all[1], 10.0);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_EQ(refused.error().sentence(), "window.reach_px: must lie between 0 and 9 px, not 10");
  EXPECT_FALSE(set_parameter(all[0], std::nan("")).has_value());
  EXPECT_EQ(options.window.reach_px, 3);
  EXPECT_EQ(options.weight, 0.5F);
}

TEST(Parameters, RefuseAFractionWhereAWholeNumberIsWanted) {
  Options options;
  EXPECT_FALSE(set_parameter(parameters_of(options)[1], 2.5).has_value());
  EXPECT_EQ(options.window.reach_px, 3);
}

TEST(Parameters, OfAStructAreCheckedTogether) {
  Options options;
  EXPECT_TRUE(check_ranges(options).has_value());
  options.window.reach_px = -1;
  EXPECT_EQ(check_ranges(options).error().place, "window.reach_px");
}

}  // namespace
}  // namespace palpable
