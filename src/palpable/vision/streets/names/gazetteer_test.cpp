// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/gazetteer.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(Gazetteer, ComparesLettersWithoutCaseAccentsAndMarks) {
  EXPECT_EQ(compared_form("Avenue de l'Hermitage"), "avenuedelhermitage");
  EXPECT_EQ(compared_form("Allée Émile \xE2\x80\x93 Straße"), "alleeemilestrasse");
  EXPECT_EQ(compared_form("南京路"), "南京路");
}

TEST(Gazetteer, CorrectsTheSpellingOfANameToTheMostSimilarOne) {
  const std::vector<std::string> names{"Boulevard des Moulins", "Boulevard du Larvotto", "Rue des Iris"};
  EXPECT_EQ(nearest_name("Boulevard des Mou1ins", names, 0.7), "Boulevard des Moulins");
  EXPECT_EQ(nearest_name("rue des lris", names, 0.7), "Rue des Iris");
  EXPECT_EQ(nearest_name("Place d'Armes", names, 0.7), std::nullopt);
  EXPECT_EQ(nearest_name("", names, 0.7), std::nullopt);
}

TEST(Gazetteer, IsATextWithOneNameALine) {
  const auto names =
      parse_gazetteer("Mill Lane\r\n\nHigh Street\n" + std::string(kMaxNameBytes + 1, 'a') + "\nEnd");
  ASSERT_TRUE(names);
  EXPECT_EQ(*names, (std::vector<std::string>{"Mill Lane", "High Street", "End"}));
  EXPECT_EQ(parse_gazetteer("\n\r\n").error().code, ErrorCode::invalid_input);
}

TEST(Gazetteer, OfTooManyNamesIsRefused) {
  std::string text;
  for (std::size_t k = 0; k < kMaxNames; ++k) text += "a\n";
  EXPECT_EQ(parse_gazetteer(text)->size(), kMaxNames);
  EXPECT_EQ(parse_gazetteer(text + "a").error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace palpable::vision
