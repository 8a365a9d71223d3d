// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/suggest.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

const std::vector<std::string> kCommands{"touch", "make", "depth", "probe", "sample", "score"};

TEST(Suggestion, CorrectsATypingError) {
  EXPECT_EQ(suggestion("tuoch", kCommands), "touch");
  EXPECT_EQ(suggestion("dept", kCommands), "depth");
  EXPECT_EQ(suggestion("samples", kCommands), "sample");
}

TEST(Suggestion, CompletesAnAbbreviation) {
  const std::vector<std::string> options{"--calibration", "--depth-as", "--depth-scale", "--near",
                                         "--near-plane"};
  EXPECT_EQ(suggestion("--calib", options), "--calibration");
  EXPECT_EQ(suggestion("--depth", options), std::nullopt) << "of two";
}

TEST(Suggestion, StaysSilentWhereNothingIsNear) {
  EXPECT_EQ(suggestion("xyzzy", kCommands), std::nullopt);
  EXPECT_EQ(suggestion("", kCommands), std::nullopt);
}

TEST(UnknownWord, ListsWhatThereIsAndWhatWasMeant) {
  EXPECT_EQ(unknown_word("tuoch", kCommands),
            "'tuoch' is not one of touch, make, depth, probe, sample, score; did you mean touch?");
  EXPECT_EQ(unknown_word("xyzzy", kCommands),
            "'xyzzy' is not one of touch, make, depth, probe, sample, score");
  EXPECT_EQ(unknown_word("make", kCommands), "");
}

}  // namespace
}  // namespace palpable::cli
