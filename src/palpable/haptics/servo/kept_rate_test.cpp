// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/kept_rate.hpp"

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

TEST(KeptRate, IsRefusedWithItsFigureWhereTooManyDeadlinesWereMissed) {
  EXPECT_TRUE(check_kept({4000.0, 1000, 200}));
  const auto refused = check_kept({4000.0, 1000, 400});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::failed);
  EXPECT_EQ(refused.error().message,
            "this machine does not keep a loop of 4000 Hz now: an empty one missed 40 % of its deadlines, "
            "which leaves 2400 Hz; choose a lower rate");
  EXPECT_FALSE(check_kept({}));
}

TEST(KeptRate, IsMeasuredByTheDeadlinesThatWereDue) {
  const KeptRate kept = measure_rate(500.0, 0.1, 0);
  EXPECT_GE(kept.due, 50U);
  EXPECT_LE(kept.missed, kept.due);
}

}  // namespace
}  // namespace palpable::haptics
