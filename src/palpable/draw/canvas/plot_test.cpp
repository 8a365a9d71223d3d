// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::draw {
namespace {

using ::testing::ElementsAre;

TEST(RoundTicks, AreRoundAndInsideTheRange) {
  EXPECT_THAT(round_ticks(-50.0, 50.0, 6), ElementsAre(-40.0, -20.0, 0.0, 20.0, 40.0));
  EXPECT_THAT(round_ticks(0.0, 15.0, 4), ElementsAre(0.0, 5.0, 10.0, 15.0));
  EXPECT_TRUE(round_ticks(1.0, 1.0, 5).empty());
}

TEST(LabelOf, ShowsTheDecimalsThatTheStepNeeds) {
  EXPECT_EQ(label_of(2.5, 0.5), "2.5");
  EXPECT_EQ(label_of(20.0, 20.0), "20");
  EXPECT_EQ(label_of(-0.0001, 0.5), "0.0");
  EXPECT_EQ(label_of(-10.0, 10.0), "\u221210");
  EXPECT_EQ(label_of(100.0, 0.0), "100");
}

TEST(Plot, PutsTheTopValueAtTheTop) {
  const Plot plot{{10.0, 20.0, 100.0, 50.0}, -1.0, 1.0, 0.0, 5.0};
  EXPECT_DOUBLE_EQ(plot.x(-1.0), 10.0);
  EXPECT_DOUBLE_EQ(plot.x(1.0), 110.0);
  EXPECT_DOUBLE_EQ(plot.y(5.0), 20.0);
  EXPECT_DOUBLE_EQ(plot.y(0.0), 70.0);
}

}  // namespace
}  // namespace palpable::draw
