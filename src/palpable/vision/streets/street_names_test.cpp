// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/street_names.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(StreetNames, FragmentsAreNoNames) {
  for (const char* name :
       {"Rue d'Alsace", "St. Martins-Ring", "5th Avenue", "Émile Zola", "Quai Antoine 1er"})
    EXPECT_TRUE(is_whole_name(name)) << name;
  for (const char* name : {"ue Saige", "de la Turbie", "Monaco:Ville", "Allee \\azare", ""})
    EXPECT_FALSE(is_whole_name(name)) << name;
}

/// A map of 200 x 100 pixels with one street along y = 50, and lettering on it from `first` to `last`.
std::string name_read(double first, double last) {
  StreetMap map;
  map.width_px = 200;
  map.height_px = 100;
  map.streets = {{"", 12.0, {{0, 50}, {199, 50}}}};
  TextLine line;
  line.height_px = 10.0;
  for (double x = first; x <= last; ++x) line.centre.push_back({x, 50.0});
  const std::array<TextLine, 1> lines{line};
  const std::array<ReadLine, 1> read{ReadLine{"Mill Lane", 0.95, false}};
  add_names(map, lines, read);
  return map.streets[0].name;
}

TEST(StreetNames, LetteringAtTheBorderMayBeCutOff) {
  EXPECT_EQ(name_read(40, 120), "Mill Lane");
  EXPECT_EQ(name_read(2, 82), "");
  EXPECT_EQ(name_read(116, 197), "");
}

}  // namespace
}  // namespace palpable::vision
