// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/scene_forms.hpp"

#include "palpable/page/shelf/scene_card.hpp"

#include <gmock/gmock.h>

namespace palpable::page::shelf {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

TEST(SceneForms, AreThoseThatExportHasForTheKind) {
  EXPECT_THAT(forms_of("a relief"),
              ElementsAre("phone", "swell", "braille", "pins", "print", "model", "scene"));
  EXPECT_THAT(forms_of(kMapKind), Contains("words"));
  EXPECT_THAT(forms_of(kGridKind), Not(Contains("print")));
  EXPECT_THAT(forms_of("a kind of a newer program"), Contains("phone"));
}

TEST(SceneForms, BecomeOptionsOfExport) {
  const auto drawing = save_words({"x", "swell", "A3", "en"}, "a relief").value();
  EXPECT_EQ(drawing.suffix, ".svg");
  EXPECT_THAT(drawing.options, ElementsAre("--paper", "A3"));
  EXPECT_THAT(save_words({"x", "braille", "A4", "de"}, kMapKind).value().options,
              ElementsAre("--braille-table", "de-g1.ctb", "--paper", "A4"));
  EXPECT_THAT(save_words({"x", "braille", {}, "--json"}, kMapKind).value().options, IsEmpty())
      << "an unknown language has no table of its own";
  const auto page = save_words({"x", "phone", "A3", "de"}, "a relief").value();
  EXPECT_EQ(page.suffix, ".html");
  EXPECT_THAT(page.options, IsEmpty()) << "a page is on no paper";
  EXPECT_FALSE(page.is_copy);
  EXPECT_TRUE(save_words({"x", "scene", {}, "en"}, kMapKind).value().is_copy);
}

TEST(SceneForms, RefusesOthers) {
  EXPECT_FALSE(save_words({"x", "words", {}, "en"}, "a relief"));
  EXPECT_FALSE(save_words({"x", "print", {}, "en"}, kGridKind));
  EXPECT_FALSE(save_words({"x", "--grid=4", {}, "en"}, "a relief"));
  EXPECT_FALSE(save_words({"x", "swell", "A4 --quiet", "en"}, "a relief"));
}

}  // namespace
}  // namespace palpable::page::shelf
