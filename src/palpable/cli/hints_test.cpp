// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/hints.hpp"

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

TEST(Hints, NameTheOptionThatWouldHelpAfterAnError) {
  const Error error = invalid_input("states no camera", "depth.png", Reason::needs_calibration);
  EXPECT_EQ(sentence_of(error), "depth.png: states no camera (--calibration FILE)");
}

TEST(Hints, StandBeforeTheFullStopOfANote) {
  EXPECT_EQ(sentence_of(Note("1000 is 1 m.", Reason::depth_scale_assumed)),
            "1000 is 1 m (--depth-scale METRES).");
}

TEST(Hints, AreLeftOutWhereNoOptionHelps) {
  EXPECT_EQ(sentence_of(Note("The pictures are swapped.")), "The pictures are swapped.");
  EXPECT_EQ(sentence_of(invalid_input("is damaged", "a.png")), "a.png: is damaged");
}

TEST(Hints, ThereIsOneForEveryReason) {
  for (int reason = 1; reason <= static_cast<int>(Reason::port_in_use); ++reason)
    EXPECT_FALSE(hint_for(static_cast<Reason>(reason)).empty()) << reason;
}

}  // namespace
}  // namespace palpable::cli
