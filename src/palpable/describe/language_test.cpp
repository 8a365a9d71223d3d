// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/language.hpp"

#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"

#include <thread>

#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

TEST(Language, NumbersUnitsAndPlacesAreSaidInIt) {
  EXPECT_EQ(spoken_length(0.0025), "2.5 millimetres");
  const LanguageScope german(Language::german);
  EXPECT_EQ(spoken_length(-0.0025), "minus 2,5 Millimeter");
  EXPECT_EQ(spoken_lengths(0.001, "to", 0.013), "1 bis 13 Millimeter");
  EXPECT_EQ(offset_words(0.012, -0.005), "12 Millimeter rechts, 5 Millimeter unterhalb");
  EXPECT_EQ(capitalised("über"), "Über");
  {
    const LanguageScope spanish(Language::spanish);
    EXPECT_EQ(slope_words(1.0, 0.0), "sube mucho hacia la derecha");
    EXPECT_EQ(counted(1, "object", "objects"), "1 objeto");
    EXPECT_EQ(counted(0, "line", "lines"), "sin líneas");
  }
  EXPECT_EQ(counted(2, "object", "objects"), "2 Objekte");
}

TEST(Language, IsOfItsThreadAlone) {
  const LanguageScope german(Language::german);
  Language other = Language::german;
  std::thread([&other] { other = current_language(); }).join();
  EXPECT_EQ(other, Language::english);
}

TEST(Language, TextsThatAreNoMessagesStayAsTheyAre) {
  const LanguageScope german(Language::german);
  EXPECT_EQ(known("{} my own %s"), "{} my own %s");
  EXPECT_EQ(language_from("fr"), std::nullopt);
}

}  // namespace
}  // namespace palpable::describe
