// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/rate_limit.hpp"

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

TEST(RateLimit, AcceptsThePaceOfAFastUser) {
  RateLimit limit({.per_s = 250, .burst = 500, .most_drops = 1000});
  for (int i = 0; i < 6000; ++i) EXPECT_EQ(limit.check(i / 200.0), Verdict::accept);
}

TEST(RateLimit, DropsAFloodThenDisconnects) {
  RateLimit limit({.per_s = 100, .burst = 10, .most_drops = 50});
  int accepted = 0;
  int dropped = 0;
  Verdict last = Verdict::accept;
  for (int i = 0; i < 200 && last != Verdict::disconnect; ++i) {
    last = limit.check(i * 1e-4);
    accepted += last == Verdict::accept ? 1 : 0;
    dropped += last == Verdict::drop ? 1 : 0;
  }
  EXPECT_EQ(last, Verdict::disconnect);
  EXPECT_LE(accepted, 12);
  EXPECT_EQ(dropped, 50);
}

TEST(RateLimit, ResetsAfterAQuietSecond) {
  RateLimit limit({.per_s = 10, .burst = 1, .most_drops = 3});
  double now_s = 0.0;
  for (int round = 0; round < 20; ++round, now_s += 2.0) {
    EXPECT_EQ(limit.check(now_s), Verdict::accept);
    EXPECT_EQ(limit.check(now_s), Verdict::drop);
    EXPECT_EQ(limit.check(now_s), Verdict::drop);
  }
}

}  // namespace
}  // namespace palpable::page
