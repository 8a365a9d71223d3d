// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/terminal_keys.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

using Name = TerminalKey::Name;

std::vector<TerminalKey> keys_of(std::string bytes) {
  std::vector<TerminalKey> keys;
  while (const auto key = take_key(bytes)) keys.push_back(*key);
  return keys;
}

TEST(TerminalKeys, AreArrowsWithAndWithoutShift) {
  EXPECT_EQ(keys_of("\x1b[A\x1b[B\x1b[C\x1b[D"),
            (std::vector<TerminalKey>{{Name::up}, {Name::down}, {Name::right}, {Name::left}}));
  EXPECT_EQ(keys_of("\x1b[1;2A\x1bOD"), (std::vector<TerminalKey>{{Name::up, '\0', true}, {Name::left}}));
}

TEST(TerminalKeys, AreLettersInLowerCase) {
  EXPECT_EQ(keys_of("Dp"), (std::vector<TerminalKey>{{Name::character, 'd'}, {Name::character, 'p'}}));
}

TEST(TerminalKeys, ArePagesAndHomeOfSeveralTerminals) {
  EXPECT_EQ(keys_of("\x1b[5~\x1b[6~\x1b[H\x1b[1~"),
            (std::vector<TerminalKey>{{Name::page_up}, {Name::page_down}, {Name::home}, {Name::home}}));
}

TEST(TerminalKeys, WaitForTheRestOfASequence) {
  std::string bytes = "\x1b[";
  EXPECT_FALSE(take_key(bytes));
  bytes += "A";
  EXPECT_EQ(take_key(bytes), TerminalKey{Name::up});
}

TEST(TerminalKeys, SkipSequencesOfOtherKeys) {
  EXPECT_EQ(keys_of("\x1b[15~\x1b[3~d"), (std::vector<TerminalKey>{{Name::character, 'd'}}));
}

}  // namespace
}  // namespace palpable::cli
