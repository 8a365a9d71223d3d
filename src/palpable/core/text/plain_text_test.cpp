// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/plain_text.hpp"

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

TEST(PlainText, MakesNamesWithoutControlsAndSpareBlanks) {
  EXPECT_EQ(plain_name("  a\nb\t \x1b c\xE2\x80\xAE\xE2\x81\xA6 "), "a b c");
  EXPECT_EQ(plain_name(" \t\n\xE2\x80\xAE "), "");
  EXPECT_EQ(plain_name("Rue de l'\xC3\x89t\xC3\xA9"), "Rue de l'\xC3\x89t\xC3\xA9");
}

TEST(PlainText, RecognisesUtf8) {
  for (const std::string valid :
       {"", "a", "\xC3\xA9", "\xED\x95\x9C", "\xF0\x9F\x98\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_TRUE(is_utf8(valid)) << valid;
  for (const std::string invalid : {"\xE9t\xE9", "\xC3", "\x80", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80",
                                    "\xF4\x90\x80\x80", "\xFF", "a\xE2\x80"})
    EXPECT_FALSE(is_utf8(invalid)) << invalid;
}

TEST(PlainText, TakesTheMarkAndLineEndsOfOtherSystemsAway) {
  EXPECT_EQ(with_plain_lines("\xEF\xBB\xBFone\r\ntwo\r\n"), "one\ntwo\n");
  EXPECT_EQ(with_plain_lines("a\rb"), "a\rb");
  EXPECT_EQ(with_plain_lines(""), "");
}

TEST(PlainText, EndsWithinACharacterThatIsCutOff) {
  EXPECT_EQ(without_control_characters("a\xE2\x80"), "a\xE2\x80");
  EXPECT_EQ(without_control_characters(""), "");
}

}  // namespace
}  // namespace palpable
