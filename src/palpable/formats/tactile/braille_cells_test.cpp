// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/braille_cells.hpp"

#include "palpable/formats/tactile/braille_page.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

TEST(Braille, WritesLettersCapitalsAndNumbers) {
  // Unified English Braille: capitals with dot 6, numbers with dots 3456.
  EXPECT_EQ(braille_ascii(plain_braille("High Street 12")), ",HIGH ,STREET #AB");
  EXPECT_EQ(braille_ascii(plain_braille("km 10-20")), "KM #AJ-#BJ");
  EXPECT_EQ(braille_ascii(plain_braille("St. John's")), ",ST4 ,JOHN'S");
  // One sign for one character that it does not know.
  EXPECT_EQ(plain_braille("é").size(), 2U);
}

TEST(Braille, OfLiblouisIsThatOfItsTable) {
  const std::vector<std::string> lines{"High Street 12", "", "Rue Émile Zola"};
  const auto braille = translated_braille(lines, "en-ueb-g1.ctb");
  if (!braille) {
    EXPECT_NE(braille.error().message.find("liblouis-bin"), std::string::npos);
    GTEST_SKIP() << "lou_translate is not installed";
  }
  ASSERT_EQ(braille->size(), 3U);
  EXPECT_EQ((*braille)[0], plain_braille(lines[0]));
  EXPECT_TRUE((*braille)[1].empty());
  // e with an acute accent: dots 45 34 before it.
  EXPECT_EQ(braille_ascii((*braille)[2]), ",RUE ,^/EMILE ,ZOLA");
}

TEST(Braille, SaysWhichLinesATableCannotWrite) {
  const std::vector<std::string> lines{"High Street", "Rue Émile Zola", "\xED\x9B\x84 Street", "\xD7\x90"};
  const auto writable = writable_in_braille(lines, "en-ueb-g1.ctb");
  if (!writable) GTEST_SKIP() << "lou_translate is not installed";
  EXPECT_EQ(*writable, (std::vector<bool>{true, true, false, false}));
  EXPECT_EQ(*writable_in_braille(std::vector<std::string>{"a"}, "any"), std::vector<bool>{true});
}

TEST(Braille, RefusesNamesThatAreNoTables) {
  const std::vector<std::string> lines{"a"};
  EXPECT_EQ(translated_braille(lines, "--help").error().code, ErrorCode::usage);
  EXPECT_EQ(translated_braille(lines, "../passwd x").error().code, ErrorCode::usage);
  EXPECT_EQ(translated_braille(lines, "no-such-table.ctb").error().code, ErrorCode::failed);
}

TEST(Braille, WrapsAtBlanksWithAnIndent) {
  const auto rows = wrapped({plain_braille("abc def ghij"), plain_braille("abcdefghijkl")}, 8);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(braille_ascii(rows[0]), "ABC DEF");
  EXPECT_EQ(braille_ascii(rows[1]), "  GHIJ");
  EXPECT_EQ(braille_ascii(rows[2]), "ABCDEFGH");
  EXPECT_EQ(braille_ascii(rows[3]), "  IJKL");
}

TEST(Braille, DividesLongWordsBetweenSignsOnly) {
  const auto pieces = [](const std::string& word) {
    std::vector<std::string> out;
    for (const BrailleLine& line : wrapped({plain_braille(word)}, 10)) out.push_back(braille_ascii(line));
    return out;
  };
  // A capital sign stays with its letter, and a number is one.
  EXPECT_EQ(pieces("abcdefghiJklm"), (std::vector<std::string>{"ABCDEFGHI", "  ,JKLM"}));
  EXPECT_EQ(pieces("abcdef12345"), (std::vector<std::string>{"ABCDEF", "  #ABCDE"}));
  EXPECT_EQ(pieces("12345678901234"), (std::vector<std::string>{"#ABCDEFGHI", "  JABCD"}));
  EXPECT_EQ(pieces("ab cdefghijklm"), (std::vector<std::string>{"AB CDEFGHI", "  JKLM"}));
  // An accent is dots 4 and 5, a second cell, and the letter.
  BrailleLine accent(8, 1);
  accent.insert(accent.end(), {0b011000, 0b001100, 0b010001, 1});
  const auto divided = wrapped({accent}, 10);
  ASSERT_EQ(divided.size(), 2U);
  EXPECT_EQ(divided[0].size(), 8U);
}

TEST(Braille, NamesTheTablesThatThereAreInPlaceOfOneThatIsNot) {
  if (check_braille_table("no-such-table.ctb")) GTEST_SKIP() << "liblouis is not installed";
  EXPECT_TRUE(check_braille_table("en-ueb-g1.ctb"));
  const auto english = check_braille_table("en-ueb-g3.ctb");
  ASSERT_FALSE(english);
  EXPECT_EQ(english.error().code, ErrorCode::usage);
  EXPECT_NE(english.error().message.find("en-ueb-g1.ctb"), std::string::npos);
  EXPECT_EQ(english.error().message.find("de-g1.ctb"), std::string::npos);
  EXPECT_NE(check_braille_table("xx.ctb").error().message.find(" de, "), std::string::npos);
}

}  // namespace
}  // namespace palpable::formats
