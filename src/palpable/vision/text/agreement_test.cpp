// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/agreement.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(ReadingAgreement, IsOfNamesWithoutCaseAndAccents) {
  const auto votes =
      votes_of_readings({{"Rue Plati", 0.8}, {"", 0.0}, {"Rue Plâti", 0.9}, {"Rue Plato", 0.7}});
  ASSERT_EQ(votes.size(), 2U);
  EXPECT_EQ(votes[0].count, 2);
  EXPECT_EQ(votes[0].best.text, "Rue Plâti");
  EXPECT_NEAR(votes[0].weight, 0.64 + 0.81, 1e-12);
}

TEST(ReadingAgreement, DropsSingleLettersThatAreMarksBesideAName) {
  const auto votes =
      votes_of_readings({{"Rue des Açores À", 0.95}, {"Rue des Acores", 0.9}, {"4 Rue des Acores", 0.8}});
  ASSERT_EQ(votes.size(), 1U);
  EXPECT_EQ(votes[0].best.text, "Rue des Açores");
  EXPECT_EQ(votes[0].count, 3);
}

TEST(ReadingAgreement, DropsMarksThatAreReadDifferently) {
  const auto votes = votes_of_readings(
      {{"Rue Bellevue, a", 0.8}, {"Æ Rue Bellevue", 0.8}, {"7 Rue Bellevue", 0.7}, {"Rue Bellevue «a", 0.9}});
  ASSERT_EQ(votes.size(), 1U);
  EXPECT_EQ(votes[0].best.text, "Rue Bellevue");
}

TEST(ReadingAgreement, KeepsSingleLettersThatMostReadingsSay) {
  const auto votes = votes_of_readings({{"Avenue A", 0.9}, {"Avenue A", 0.9}, {"Avenue", 0.9}});
  ASSERT_EQ(votes.size(), 2U);
  EXPECT_EQ(votes[0].best.text, "Avenue A");
}

TEST(ReadingAgreement, IsOfReadingsThatDifferByThinLetters) {
  const auto votes = votes_of_readings({{"Kohlplatz", 0.8}, {"Kohiplatz", 0.9}, {"Kohlplatz", 0.8}});
  ASSERT_EQ(votes.size(), 1U);
  EXPECT_EQ(votes[0].best.text, "Kohlplatz");
  EXPECT_EQ(votes[0].count, 3);
}

}  // namespace
}  // namespace palpable::vision
