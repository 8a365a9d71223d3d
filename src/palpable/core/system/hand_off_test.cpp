// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/hand_off.hpp"

#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace palpable {
namespace {

/// Large enough that a torn copy is detected.
struct Wide {
  std::array<std::uint64_t, 40> words{};
  static Wide of(std::uint64_t n) {
    Wide wide;
    wide.words.fill(n);
    return wide;
  }
  bool whole() const {
    for (const auto word : words)
      if (word != words[0]) return false;
    return true;
  }
};

TEST(LatestValue, GivesTheNewestOnceAndNothingBeforeTheFirst) {
  LatestValue<int> cell;
  int value = -1;
  EXPECT_FALSE(cell.take(value));
  EXPECT_EQ(value, -1);
  cell.put(1);
  cell.put(2);
  EXPECT_TRUE(cell.take(value));
  EXPECT_EQ(value, 2);
  EXPECT_FALSE(cell.take(value));
}

TEST(LatestValue, NeverTearsNorGoesBackwardsBetweenThreads) {
  // Ends after a number of values taken while the writer was running, not after a time.
  constexpr int kExchanges = 20000;
  LatestValue<Wide> cell;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    // Where both threads share a processor, one that never yields would exchange one value per time slice.
    constexpr std::uint64_t kValuesAtOnce = 8;
    for (std::uint64_t n = 1; !done.load(std::memory_order_relaxed); ++n) {
      cell.put(Wide::of(n));
      if (n % kValuesAtOnce == 0) std::this_thread::yield();
    }
  });
  int exchanges = 0;
  std::uint64_t last = 0;
  bool whole = true;
  bool forwards = true;
  Wide value;
  while (exchanges < kExchanges) {
    if (!cell.take(value)) {
      std::this_thread::yield();
      continue;
    }
    whole = whole && value.whole();
    forwards = forwards && value.words[0] > last;
    last = value.words[0];
    ++exchanges;
  }
  done = true;
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(forwards);
  EXPECT_EQ(exchanges, kExchanges);
  EXPECT_GE(last, static_cast<std::uint64_t>(kExchanges));
}

TEST(Ring, RefusesAndCountsWhenFull) {
  Ring<int> ring(3);
  ASSERT_EQ(ring.capacity(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.put(i));
  EXPECT_FALSE(ring.has_room());
  EXPECT_FALSE(ring.put(4));
  EXPECT_EQ(ring.refused(), 1U);
  EXPECT_EQ(ring.take(), 0);
  EXPECT_TRUE(ring.has_room());
  EXPECT_TRUE(ring.put(5));
  for (const int expected : {1, 2, 3, 5}) EXPECT_EQ(ring.take(), expected);
  EXPECT_EQ(ring.take(), std::nullopt);
}

TEST(Ring, LosesNothingAndKeepsTheOrderBetweenThreads) {
  constexpr std::uint64_t kValues = 50000;
  Ring<Wide> ring(16);
  std::thread writer([&] {
    for (std::uint64_t n = 0; n < kValues;) {
      if (ring.put(Wide::of(n)))
        ++n;
      else
        std::this_thread::yield();
    }
  });
  std::uint64_t taken = 0;
  bool right = true;
  while (taken < kValues) {
    const auto value = ring.take();
    if (!value) {
      std::this_thread::yield();
      continue;
    }
    right = right && value->whole() && value->words[0] == taken;
    ++taken;
  }
  writer.join();
  EXPECT_TRUE(right);
  EXPECT_EQ(taken, kValues);
  EXPECT_EQ(ring.take().has_value(), false);
}

}  // namespace
}  // namespace palpable
