// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/map_words.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

std::vector<std::string> corrected(std::vector<std::string> others) {
  std::vector<ReadLine> read;
  for (const char* const sure : {"Rue Grimaldi", "Rue Basse", "Rue Saige", "Mill Road", "Station Road",
                                 "Queen Road", "Kornweg", "Arnikaweg", "Alvierweg", "Gerberweg"})
    read.push_back({sure, 0.95, false});
  const std::size_t first = read.size();
  for (std::string& text : others) read.push_back({std::move(text), 0.75, false});
  correct_by_map_words(read);
  std::vector<std::string> out;
  for (std::size_t i = first; i < read.size(); ++i) out.push_back(read[i].text);
  return out;
}

TEST(MapWords, WordsThatManyNamesHaveMendThoseThatDifferByALetter) {
  const std::vector<std::string> better{"Rue Plati", "Rue de la Turbie", "Old Road", "Egertaweg"};
  EXPECT_EQ(corrected({"Kue Plati", "ue de la Turbie", "Old Roadd", "EgertaweS"}), better);
}

TEST(MapWords, WordsFartherAwayAndTheMapsOwnStay) {
  const std::vector<std::string> same{"Avenue Basse", "Rue Grimaldi", "Am Road",
                                      "Pappelweg",    "Weg",          "Rheindamm"};
  EXPECT_EQ(corrected(same), same);
}

TEST(MapWords, OneNameDoesNotMakeAWord) {
  std::vector<ReadLine> read{{"Vue Plati", 0.95, false}, {"Rue Grimaldi", 0.95, false}};
  correct_by_map_words(read);
  EXPECT_EQ(read[0].text, "Vue Plati");
}

}  // namespace
}  // namespace palpable::vision
