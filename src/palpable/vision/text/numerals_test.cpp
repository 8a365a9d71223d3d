// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/numerals.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(Numerals, OfRulersAreNoLetters) {
  EXPECT_EQ(with_numerals("Avenue Albert Il"), "Avenue Albert II");
  EXPECT_EQ(with_numerals("Boulevard Rainier Ill"), "Boulevard Rainier III");
  EXPECT_EQ(with_numerals("Boulevard Rainier ill"), "Boulevard Rainier III");
  EXPECT_EQ(with_numerals("Boulevard Albert ler"), "Boulevard Albert 1er");
  EXPECT_EQ(with_numerals("Avenue Albert II"), "Avenue Albert II");
}

TEST(Numerals, OtherWordsStay) {
  for (const char* words :
       {"An der Ill", "Rue de l'Ill", "Illweg", "Il", "Route 11", "Old Mill", "Rue Keller", ""})
    EXPECT_EQ(with_numerals(words), words);
}

}  // namespace
}  // namespace palpable::vision
