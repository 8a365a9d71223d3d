// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/key_map.hpp"

#include <random>
#include <unordered_map>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

TEST(KeyMap, HoldsTheSameAsAnUnorderedMap) {
  KeyMap<int> map;
  std::unordered_map<std::uint64_t, int> ordinary;
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    // Neighbouring keys, as for cubes, each about twice.
    const std::uint64_t key = (random() % 100) << 40U | random() % 100;
    const auto [value, fresh] = map.put(key, i);
    const auto [at, new_there] = ordinary.try_emplace(key, i);
    EXPECT_EQ(fresh, new_there);
    EXPECT_EQ(*value, at->second);
  }
  EXPECT_EQ(map.size(), ordinary.size());
  for (const auto& [key, value] : ordinary) {
    ASSERT_NE(map.find(key), nullptr);
    EXPECT_EQ(*map.find(key), value);
    EXPECT_EQ(map.find(key + 7000), nullptr);
  }
}

}  // namespace
}  // namespace palpable::sculpt
