// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/street_names.hpp"

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

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
std::string name_read(const char* words, double first, double last) {
  StreetMap map;
  map.width_px = 200;
  map.height_px = 100;
  map.streets = {{"", 12.0, {{0, 50}, {199, 50}}}};
  TextLine line;
  line.height_px = 10.0;
  for (double x = first; x <= last; ++x) line.centre.push_back({x, 50.0});
  const std::array<TextLine, 1> lines{line};
  const std::array<ReadLine, 1> read{ReadLine{words, 0.95, false}};
  add_names(map, lines, read);
  return map.streets[0].name;
}

TEST(StreetNames, LetteringAtTheBorderMayBeCutOff) {
  EXPECT_EQ(name_read("Mitteldorf", 40, 120), "Mitteldorf");
  EXPECT_EQ(name_read("Mitteldorf", 2, 82), "");
  EXPECT_EQ(name_read("Mitteldorf", 116, 197), "");
  EXPECT_EQ(name_read("Rue Bel", 116, 197), "");
  EXPECT_EQ(name_read("ill Lane", 2, 82), "");
}

TEST(StreetNames, AWordOfStreetsAtTheBorderIsWhole) {
  EXPECT_EQ(name_read("Mill Lane", 2, 82), "Mill Lane");
  EXPECT_EQ(name_read("Rue Bel", 2, 82), "Rue Bel");
  EXPECT_EQ(name_read("Mill Lane", 116, 197), "Mill Lane");
}

/// A map of 300 x 200 pixels: a street along y = 100 in two pieces, that goes on straight ahead over the
/// junction at (150, 100), and one from there downwards.
StreetMap junction_map() {
  StreetMap map;
  map.width_px = 300;
  map.height_px = 200;
  map.streets = {{"", 12.0, {{0, 100}, {150, 100}}},
                 {"", 12.0, {{150, 100}, {299, 100}}},
                 {"", 12.0, {{150, 100}, {150, 199}}}};
  return map;
}

TextLine level_line(double first, double last, double y) {
  TextLine line;
  line.height_px = 10.0;
  for (double x = first; x <= last; ++x) line.centre.push_back({x, y});
  return line;
}

void add_name(StreetMap& map, const TextLine& line, const ReadLine& read,
              const StreetNameOptions& options = {}) {
  add_names(map, std::span(&line, 1), std::span(&read, 1), options);
}

TEST(StreetNames, GoOnStraightOverAJunction) {
  StreetMap map = junction_map();
  add_name(map, level_line(30, 110, 100), {"Mill Lane", 0.95, false});
  EXPECT_EQ(map.streets[0].name, "Mill Lane");
  EXPECT_EQ(map.streets[1].name, "Mill Lane");
  EXPECT_EQ(map.streets[2].name, "");
  ASSERT_EQ(map.labels.size(), 1U);
  EXPECT_TRUE(map.labels[0].names_street);
  EXPECT_NEAR(map.labels[0].angle_deg, 0.0, 1e-9);
  StreetMap wider = junction_map();
  wider.streets[1].width_px = 24.0;
  add_name(wider, level_line(30, 110, 100), {"Mill Lane", 0.95, false});
  EXPECT_EQ(wider.streets[1].name, "") << "twice as wide";
}

TEST(StreetNames, LetteringBesideTheStreetsIsALabel) {
  StreetMap map = junction_map();
  add_name(map, level_line(30, 110, 80), {"Town Hall", 0.95, true});
  for (const MapStreet& street : map.streets) EXPECT_EQ(street.name, "");
  ASSERT_EQ(map.labels.size(), 1U);
  EXPECT_FALSE(map.labels[0].names_street);
  EXPECT_EQ(map.labels[0].text, "Town Hall");
  // Read from the last point to the first: upside down, its first corner is at the lower right.
  EXPECT_NEAR(std::abs(map.labels[0].angle_deg), 180.0, 1e-9);
  EXPECT_NEAR(map.labels[0].box[0].x, 110.0, 1e-9);
  EXPECT_NEAR(map.labels[0].box[0].y, 85.0, 1e-9);
  // Across a street it is none of its name either.
  TextLine across = level_line(110, 190, 150);
  add_name(map, across, {"Mill Lane", 0.95, false});
  EXPECT_EQ(map.streets[2].name, "");
}

TEST(StreetNames, AreCorrectedByAGazetteer) {
  StreetNameOptions options;
  options.gazetteer = {"Mill Lane", "Station Road"};
  StreetMap map = junction_map();
  add_name(map, level_line(30, 110, 100), {"Mi1l Lanc", 0.5, false}, options);
  EXPECT_EQ(map.streets[0].name, "Mill Lane");
  EXPECT_EQ(map.labels[0].text, "Mill Lane");
  StreetMap other = junction_map();
  add_name(other, level_line(30, 110, 100), {"Bakery", 0.99, false}, options);
  EXPECT_EQ(other.streets[0].name, "");
  EXPECT_FALSE(other.labels[0].names_street);
}

TEST(StreetNames, TheSurestReadingOfAStreetWins) {
  StreetMap map = junction_map();
  const std::array<TextLine, 3> lines{level_line(20, 60, 100), level_line(70, 130, 100),
                                      level_line(160, 220, 100)};
  const std::array<ReadLine, 3> read{ReadLine{"Mill Lane", 0.8, false}, ReadLine{"Hill Lane", 0.9, false},
                                     ReadLine{"Mill Lone", 0.6, false}};
  add_names(map, lines, read);
  EXPECT_EQ(map.streets[0].name, "Hill Lane");
  EXPECT_EQ(map.streets[1].name, "Hill Lane") << "its own lettering was not sure enough";
}

TEST(StreetNames, AStreetIsDividedBetweenItsTwoNames) {
  // A street without a junction, with a name at each of its halves.
  StreetMap map;
  map.width_px = 300;
  map.height_px = 200;
  map.streets = {{"", 12.0, {{0, 100}, {120, 100}, {299, 100}}}};
  const std::array<TextLine, 2> lines{level_line(20, 80, 100), level_line(180, 260, 100)};
  const std::array<ReadLine, 2> read{ReadLine{"Mill Lane", 0.8, false}, ReadLine{"Station Road", 0.9, false}};
  add_names(map, lines, read);
  ASSERT_EQ(map.streets.size(), 2U);
  EXPECT_EQ(map.streets[0].name, "Mill Lane");
  EXPECT_EQ(map.streets[1].name, "Station Road");
  const MapPoint cut = map.streets[0].points.back();
  EXPECT_NEAR(cut.x, 135.0, 3.0) << "midway between 50 and 220";
  EXPECT_EQ(map.streets[1].points.front().x, cut.x);
  EXPECT_EQ(map.streets[1].points.back().x, 299.0);
}

TEST(StreetNames, ABeginningAloneIsNoName) {
  StreetMap map = junction_map();
  add_name(map, level_line(30, 110, 100), {"Rue de la", 0.95, false});
  EXPECT_EQ(map.streets[0].name, "");
}

TEST(StreetNames, WordsThatAreLetteredOtherwiseNameAPlaceIfNoneIsOfStreets) {
  TextLine line = level_line(30, 110, 100);
  const StreetLettering alike{line.height_px, line.colour};
  const StreetLettering other{line.height_px, {0, 120, 250}};
  const auto named = [&](const char* text, const StreetLettering& lettering) {
    StreetMap map = junction_map();
    const std::array<TextLine, 1> lines{line};
    const std::array<ReadLine, 1> read{ReadLine{text, 0.95, false}};
    add_names(map, lines, read, {}, lettering);
    return map.streets[0].name;
  };
  EXPECT_EQ(named("Library", other), "");
  EXPECT_EQ(named("Library", alike), "Library");
  EXPECT_EQ(named("Mill Lane", other), "Mill Lane");
}

TEST(StreetNames, StackedWordsNameAPlace) {
  StreetMap map = junction_map();
  const std::array<TextLine, 2> lines{level_line(30, 90, 100), level_line(36, 84, 114)};
  const std::array<ReadLine, 2> read{ReadLine{"Seeblick", 0.95, false, {"Seeblick"}},
                                     ReadLine{"Restaurant", 0.95, false, {"Restaurant"}}};
  add_names(map, lines, read);
  EXPECT_EQ(map.streets[0].name, "");
  ASSERT_EQ(map.labels.size(), 2U);
  EXPECT_FALSE(map.labels[0].names_street);
}

TEST(StreetNames, AGazetteerDecidesBetweenReadingsThatDiffer) {
  const std::vector<std::string> gazetteer{"Boulevard Carnot", "Rue Saige"};
  std::array<ReadLine, 2> read{ReadLine{"", 0.0, false, {"Bouleuard Camot", "Boulevard Carot"}},
                               ReadLine{"Museum", 0.9, false, {"Museum"}}};
  spell_by_gazetteer(read, gazetteer, 0.7);
  EXPECT_EQ(read[0].text, "Boulevard Carnot");
  EXPECT_GT(read[0].confidence, 0.7);
  EXPECT_EQ(read[1].text, "Museum");
  spell_by_gazetteer(read, {}, 0.0);
  EXPECT_EQ(read[1].text, "Museum");
}

}  // namespace
}  // namespace palpable::vision
