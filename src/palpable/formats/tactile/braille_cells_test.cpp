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

}  // namespace
}  // namespace palpable::formats
