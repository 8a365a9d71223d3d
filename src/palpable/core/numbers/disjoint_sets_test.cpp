// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/numbers/disjoint_sets.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(DisjointSets, AreOneWhenTheyAreConnected) {
  DisjointSets sets(6);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(sets.find(i), i);
  sets.join(0, 1), sets.join(4, 5), sets.join(1, 4);
  for (const std::size_t i : {1U, 4U, 5U}) EXPECT_EQ(sets.find(i), sets.find(0));
  EXPECT_NE(sets.find(2), sets.find(0));
  EXPECT_NE(sets.find(2), sets.find(3));
}

TEST(DisjointSets, GiveTheLeastMemberOfEach) {
  DisjointSets sets(6);
  const std::uint32_t joined = sets.join(1, 4);
  EXPECT_EQ(joined, sets.find(1));
  sets.join(5, 4), sets.join(3, 2);
  EXPECT_EQ(sets.firsts(), (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 1}));
}

}  // namespace
}  // namespace palpable
