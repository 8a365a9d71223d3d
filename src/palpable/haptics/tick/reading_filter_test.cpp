// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/reading_filter.hpp"

#include "palpable/haptics/law/test_period.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

device::Reading at(double x_m) {
  device::Reading reading;
  reading.position.v.x = x_m;
  return reading;
}

class ReadingFilterTest : public testing::Test {
 protected:
  ReadingFilterTest() : filter(traits, options) { filter.judge(at(0.0), kT_s); }
  ReadingUse judge(double x_m) { return filter.judge(at(x_m), kT_s).use; }

  device::Traits traits;
  TickOptions options;
  ReadingFilter filter;
};

TEST_F(ReadingFilterTest, AcceptsAHandsMovement) {
  EXPECT_EQ(judge(0.002), ReadingUse::continues);
  const JudgedReading judged = filter.judge(at(0.003), kT_s);
  EXPECT_FALSE(judged.first);
  EXPECT_DOUBLE_EQ(judged.passed_s, kT_s);
}

TEST_F(ReadingFilterTest, DoesNotUseAGlitch) {
  EXPECT_EQ(judge(0.02), ReadingUse::glitch);
  EXPECT_EQ(judge(-0.02), ReadingUse::glitch);
  const JudgedReading back = filter.judge(at(0.001), kT_s);
  EXPECT_EQ(back.use, ReadingUse::continues);
  EXPECT_DOUBLE_EQ(back.passed_s, 3 * kT_s);
}

TEST_F(ReadingFilterTest, BeginsANewTouchIfAJumpPersists) {
  EXPECT_EQ(judge(0.02), ReadingUse::glitch);
  EXPECT_EQ(judge(0.0201), ReadingUse::glitch);
  const JudgedReading third = filter.judge(at(0.0202), kT_s);
  EXPECT_EQ(third.use, ReadingUse::new_touch);
  EXPECT_TRUE(third.first);
  EXPECT_EQ(judge(0.0203), ReadingUse::continues);
}

TEST_F(ReadingFilterTest, HasNoPositionIfReadingsAgreeWithNoOther) {
  double side = 0.02;
  for (int k = 0; k < options.glitch_readings; ++k, side = -side) EXPECT_EQ(judge(side), ReadingUse::glitch);
  EXPECT_EQ(judge(side), ReadingUse::none);
  EXPECT_EQ(judge(std::numeric_limits<double>::quiet_NaN()), ReadingUse::none);
  device::Reading stale = at(0.0);
  stale.status = device::Status::stale;
  const JudgedReading judged = filter.judge(stale, kT_s);
  EXPECT_EQ(judged.use, ReadingUse::none);
  EXPECT_FALSE(judged.implausible);
}

TEST_F(ReadingFilterTest, FollowsAFastHandThroughAGlitch) {
  for (int k = 1; k <= 5; ++k) EXPECT_EQ(judge(0.002 * k), ReadingUse::continues);
  EXPECT_EQ(judge(-0.02), ReadingUse::glitch);
  EXPECT_EQ(judge(0.03), ReadingUse::glitch);
  EXPECT_EQ(judge(0.0165), ReadingUse::continues) << "where its velocity led";
}

TEST_F(ReadingFilterTest, DoesNotUseASingleReadingAmongNonsenseThoughAHandMightHaveReachedIt) {
  std::mt19937 random(7);
  for (int k = 0; k < 200; ++k) {
    // Each more than 3 mm away, from the hand and from the one before it.
    const double x_m =
        (k % 2 == 0 ? 1.0 : -1.0) * std::uniform_real_distribution<double>(0.003, 0.02)(random);
    const ReadingUse use = judge(x_m);
    EXPECT_TRUE(use == ReadingUse::glitch || use == ReadingUse::none) << k;
  }
  EXPECT_EQ(judge(0.0), ReadingUse::continues);
}

TEST_F(ReadingFilterTest, LetsThePointerOfADeviceWithoutMotorsMoveFaster) {
  device::Traits pointer;
  pointer.pushes_back = false;
  ReadingFilter faster(pointer, options);
  faster.judge(at(0.0), kT_s);
  EXPECT_EQ(faster.judge(at(0.007), kT_s).use, ReadingUse::continues);
  EXPECT_EQ(judge(0.007), ReadingUse::glitch);
}

}  // namespace
}  // namespace palpable::haptics
