// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/articles.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(Articles, AreNoCapitals) {
  EXPECT_EQ(with_articles("Chemin de Ja Turbie"), "Chemin de la Turbie");
  EXPECT_EQ(with_articles("Quai de I'Hirondelle"), "Quai de l'Hirondelle");
  for (const char* words : {"Rue de la Colle", "Ja Street", "Avenue Albert I", "Rue de l'Ill", ""})
    EXPECT_EQ(with_articles(words), words);
}

}  // namespace
}  // namespace palpable::vision
