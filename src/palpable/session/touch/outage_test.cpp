// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/outage.hpp"

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

TEST(Outage, IsToldOnceWhereFaultsComeInQuickSuccession) {
  Outage outage;
  EXPECT_FALSE(outage.take_end(0.0));
  int begins = 0, ends = 0;
  // Ten faults a second for two seconds, each over after 25 ms.
  double now_s = 0.0;
  for (; now_s < 2.0; now_s += 0.1) {
    begins += outage.begin() ? 1 : 0;
    outage.note_works(now_s + 0.025);
    ends += outage.take_end(now_s + 0.09) ? 1 : 0;
  }
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 0);
  for (; now_s < 5.0; now_s += 0.1) ends += outage.take_end(now_s) ? 1 : 0;
  EXPECT_EQ(ends, 1);
  // The next one is another.
  EXPECT_TRUE(outage.begin());
}

TEST(Outage, ThatWasNotToldHasNoEnd) {
  Outage outage;
  outage.note_works(1.0);
  EXPECT_FALSE(outage.take_end(9.0));
}

}  // namespace
}  // namespace palpable::session
