// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/plain_text.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(PlainText, KeepsWordsOfAnyLanguageAndLines) {
  const std::string text = "Haus, \xED\x95\x9C\xEA\xB8\x80, \xC3\xA9\n\tand more";
  EXPECT_FALSE(has_control_characters(text));
  EXPECT_EQ(without_control_characters(text), text);
}

TEST(PlainText, ReplacesControlCharactersAndDirectionOverrides) {
  for (const std::string control :
       {"\x1b", "\r", "\x7f", "\xC2\x85", "\xE2\x80\xAE", "\xE2\x81\xA6", "\x01"}) {
    EXPECT_TRUE(has_control_characters("a" + control + "b"));
    EXPECT_EQ(without_control_characters("a" + control + "b"), "a?b");
  }
  EXPECT_EQ(without_control_characters(std::string("a\0b", 3)), "a?b");
}

TEST(PlainText, EndsWithinACharacterThatIsCutOff) {
  EXPECT_EQ(without_control_characters("a\xE2\x80"), "a\xE2\x80");
  EXPECT_EQ(without_control_characters(""), "");
}

}  // namespace
}  // namespace palpable
