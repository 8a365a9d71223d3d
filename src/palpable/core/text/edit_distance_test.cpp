// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/edit_distance.hpp"

#include <string>

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(EditDistance, CountsChangesAndExchangesOfNeighbours) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("relief", ""), 6U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("proxy", "porxy"), 1U);
  EXPECT_EQ(edit_distance("porxy", "proxy"), 1U);
}

TEST(EditDistance, TextsLongerThanAnyNameDifferAsAWhole) {
  const std::string longest(kLongestCompared, 'a'), longer = longest + "a";
  EXPECT_EQ(edit_distance(longest, longest.substr(1)), 1U);
  EXPECT_EQ(edit_distance(longer, longest), longer.size());
  EXPECT_EQ(edit_distance(longer, longer), 0U);
}

}  // namespace
}  // namespace palpable
