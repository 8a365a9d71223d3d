// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/sound_words.hpp"

#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

TEST(SoundWords, NameTheNearestEighthOfATurn) {
  EXPECT_EQ(sound_words(20.0, std::nullopt), "ahead");
  EXPECT_EQ(sound_words(-31.0, 10.0), "ahead, to the left");
  EXPECT_EQ(sound_words(91.0, 45.0), "to the right and above");
  EXPECT_EQ(sound_words(-135.0, -45.0), "behind, to the left and below");
  EXPECT_EQ(sound_words(-106.0, 88.0), "above");
  EXPECT_EQ(sound_words(-179.0, std::nullopt), "behind");
  EXPECT_EQ(sound_words(180.0, std::nullopt), "behind");
}

}  // namespace
}  // namespace palpable::describe
