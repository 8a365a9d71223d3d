// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/streets_under_names.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TextLine upright_line(double x, double first, double last) {
  TextLine out;
  out.height_px = 10.0;
  out.colour = {40, 40, 40};
  for (double y = first; y <= last; ++y) out.centre.push_back({x, y});
  return out;
}

/// A street along y = 50 with three names on it, and lettering that leads up from it.
struct MapOfOneStreet {
  CentreLines graph{{{0, 50}, {300, 50}}, {}};
  std::vector<TextLine> lines;
  std::vector<ReadLine> read{3, ReadLine{"Mill Lane", 0.95, false}};

  MapOfOneStreet() {
    connect_nodes(graph, 0, 1, 6.0);
    for (const double first : {10.0, 110.0, 210.0}) {
      TextLine line = upright_line(0.0, 0.0, 60.0);
      for (MapPoint& p : line.centre) p = {first + p.y, 50.0};
      lines.push_back(line);
    }
    lines.push_back(upright_line(100.0, 60.0, 140.0));
  }
  int added(const char* name, double confidence = 0.95) {
    read.resize(3);
    read.push_back({name, confidence, false});
    return add_streets_under(graph, lines, read);
  }
};

TEST(StreetsUnderNames, ANameOfAStreetThatLiesOnNoneIsAStreet) {
  MapOfOneStreet map;
  EXPECT_EQ(map.added("Rue Plati"), 1);
  // It meets the street that its beginning faces.
  EXPECT_EQ(map.graph.lines.size(), 3U);
  const std::vector<int> degrees = degrees_of(map.graph);
  EXPECT_EQ(std::count(degrees.begin(), degrees.end(), 3), 1);
}

TEST(StreetsUnderNames, ANameThatIsReadAsSurelyAsThoseOfStreetsIsEnough) {
  MapOfOneStreet map;
  EXPECT_EQ(map.added("Rue Plati", 0.6), 0);
  EXPECT_EQ(map.added("Rue Plati", 0.75), 1);
}

TEST(StreetsUnderNames, NamesOfPlacesAndOtherLetteringAreNone) {
  MapOfOneStreet map;
  EXPECT_EQ(map.added("Monaco"), 0);
  map.lines.back().colour = {40, 40, 220};
  EXPECT_EQ(map.added("Rue Plati"), 0);
  map.lines.back().colour = {40, 40, 40};
  map.lines.back().height_px = 20.0;
  EXPECT_EQ(map.added("Rue Plati"), 0);
}

TEST(StreetsUnderNames, PalerLettersSayAStreetIfTheirWordsDo) {
  MapOfOneStreet map;
  map.lines.back().colour = {80, 80, 80};
  EXPECT_FALSE(is_lettered_like(map.lines.back(), {10.0, {40, 40, 40}}));
  EXPECT_EQ(map.added("Rue Plati"), 1);
  map.lines.back().colour = {100, 100, 100};
  EXPECT_EQ(map.added("Rue Plati"), 0);
}

TEST(StreetsUnderNames, TooFewNamesShowNoLettering) {
  MapOfOneStreet map;
  map.read[0].confidence = 0.1;
  EXPECT_EQ(map.added("Rue Plati"), 0);
}

}  // namespace
}  // namespace palpable::vision
