// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/graph/street_graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

using ::testing::UnorderedElementsAre;

/// A map of 200 x 150 pixels of land (colour 0) and streets (colour 1), with known centre lines.
class KnownStreets {
 public:
  KnownStreets() {
    colours_.frame.corners = {{0, 0}, {kWidth - 1, 0}, {kWidth - 1, kHeight - 1}, {0, kHeight - 1}};
    colours_.colours = {{{240, 240, 230}, kWidth * kHeight}, {{255, 255, 255}, 0}};
    colours_.of_pixel = Raster<std::uint8_t>(kWidth, kHeight, 0);
    colours_.seen = Raster<std::uint8_t>(kWidth, kHeight, MapColours::kArea);
    layers_.resize(2);
    layers_[1].layer = MapLayer::street;
  }

  int node(MapPoint at) {
    auto& nodes = layers_[1].lines.nodes;
    nodes.push_back(at);
    return static_cast<int>(nodes.size()) - 1;
  }
  /// A straight street between two nodes, drawn with this radius.
  void street(int first, int last, double radius_px) {
    CentreLines& lines = layers_[1].lines;
    const MapPoint a = lines.nodes[static_cast<std::size_t>(first)];
    const MapPoint b = lines.nodes[static_cast<std::size_t>(last)];
    CentreLine line{{}, first, last, radius_px, 0.0};
    const int steps = static_cast<int>(std::lround(std::hypot(b.x - a.x, b.y - a.y)));
    for (int i = 0; i <= steps; ++i) {
      line.points.push_back({a.x + (b.x - a.x) * i / steps, a.y + (b.y - a.y) * i / steps});
      paint(line.points.back(), radius_px);
    }
    lines.lines.push_back(std::move(line));
  }
  void street(MapPoint a, MapPoint b, double radius_px) {
    const int first = node(a);
    street(first, node(b), radius_px);
  }
  /// Lettering or symbols cover the picture between two columns.
  void cover(int left, int right) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = left; x <= right; ++x) colours_.seen(x, y) = 0;
  }
  CentreLines joined(const std::vector<TextLine>& names = {}) const {
    return join_streets(colours_, layers_, names);
  }
  CentreLines joined_with_path(MapPoint a, MapPoint b) const {
    CentreLines paths{{a, b}, {}};
    connect_nodes(paths, 0, 1, 1.0);
    paths.lines[0].kind = MapStreet::Kind::path;
    return join_paths(joined(), paths, colours_, layers_, {});
  }

 private:
  static constexpr int kWidth = 200, kHeight = 150;
  void paint(MapPoint at, double radius_px) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (std::hypot(x - at.x, y - at.y) <= radius_px) colours_.of_pixel(x, y) = 1;
  }
  MapColours colours_;
  std::vector<LayerOfColour> layers_;
};

/// The nodes at which this number of lines meet, to the pixel.
std::vector<std::pair<int, int>> places_of_degree(const CentreLines& graph, int degree) {
  const std::vector<int> degrees = degrees_of(graph);
  std::vector<std::pair<int, int>> out;
  for (std::size_t n = 0; n < degrees.size(); ++n)
    if (degrees[n] == degree)
      out.emplace_back(static_cast<int>(std::lround(graph.nodes[n].x)),
                       static_cast<int>(std::lround(graph.nodes[n].y)));
  return out;
}

TextLine level_name(int left, int right, int y, double height_px) {
  TextLine name;
  name.height_px = height_px;
  for (int x = left; x <= right; ++x) name.centre.push_back({static_cast<double>(x), static_cast<double>(y)});
  return name;
}

TEST(StreetGraph, AStreetEndsInTheMiddleOfTheStreetThatItMeets) {
  KnownStreets map;
  map.street({0, 60}, {199, 60}, 5.0);
  map.street({100, 67}, {100, 149}, 5.0);
  const CentreLines graph = map.joined();
  EXPECT_EQ(graph.lines.size(), 3U);
  EXPECT_THAT(places_of_degree(graph, 3), UnorderedElementsAre(std::pair(100, 60)));
  EXPECT_THAT(places_of_degree(graph, 1),
              UnorderedElementsAre(std::pair(0, 60), std::pair(199, 60), std::pair(100, 149)));
}

TEST(StreetGraph, AStreetThatEndsInLandMeetsNone) {
  KnownStreets map;
  map.street({0, 60}, {199, 60}, 5.0);
  map.street({100, 85}, {100, 149}, 5.0);
  const CentreLines graph = map.joined();
  EXPECT_EQ(graph.lines.size(), 2U);
  EXPECT_THAT(places_of_degree(graph, 1), UnorderedElementsAre(std::pair(0, 60), std::pair(199, 60),
                                                               std::pair(100, 85), std::pair(100, 149)));
}

TEST(StreetGraph, GapsAreClosedOnlyWhereSomethingCoversThem) {
  KnownStreets open, covered;
  for (KnownStreets* map : {&open, &covered}) {
    map->street({0, 60}, {70, 60}, 5.0);
    map->street({130, 60}, {199, 60}, 5.0);
  }
  covered.cover(71, 129);
  EXPECT_THAT(places_of_degree(covered.joined(), 1),
              UnorderedElementsAre(std::pair(0, 60), std::pair(199, 60)));
  EXPECT_EQ(covered.joined().lines.size(), 1U);
  EXPECT_EQ(open.joined().lines.size(), 2U);
}

TEST(StreetGraph, StreetsOfOtherWidthsOrDirectionsAreNotJoined) {
  const auto count = [](double radius_px, double right_y) {
    KnownStreets map;
    map.street({0, 60}, {80, 60}, 3.0);
    map.street({120, right_y}, {199, right_y}, radius_px);
    map.cover(81, 119);
    return map.joined().lines.size();
  };
  EXPECT_EQ(count(3.0, 60), 1U);
  EXPECT_EQ(count(7.0, 60), 1U);
  EXPECT_EQ(count(9.0, 60), 2U) << "three times as wide";
  EXPECT_EQ(count(3.0, 75), 1U) << "20.6 degrees aside";
  EXPECT_EQ(count(3.0, 85), 2U) << "32 degrees aside";
}

TEST(StreetGraph, TwoJunctionsNearerThanTheStreetIsWideAreOne) {
  KnownStreets map;
  const int left = map.node({0, 60}), a = map.node({98, 60}), b = map.node({102, 60}),
            right = map.node({199, 60}), up = map.node({98, 0}), down = map.node({102, 149});
  map.street(left, a, 5.0);
  map.street(a, b, 5.0);
  map.street(b, right, 5.0);
  map.street(up, a, 5.0);
  map.street(b, down, 5.0);
  const CentreLines graph = map.joined();
  EXPECT_EQ(graph.lines.size(), 4U);
  EXPECT_THAT(places_of_degree(graph, 4), UnorderedElementsAre(std::pair(100, 60)));
  EXPECT_TRUE(places_of_degree(graph, 3).empty());
}

TEST(StreetGraph, FragmentsAreNoStreets) {
  KnownStreets map;
  map.street({0, 60}, {199, 60}, 5.0);
  map.street({60, 110}, {80, 110}, 4.0);
  map.street({100, 110}, {150, 110}, 4.0);
  // 20 px are less than six radii of 4 px, 50 px are more.
  EXPECT_THAT(
      places_of_degree(map.joined(), 1),
      UnorderedElementsAre(std::pair(0, 60), std::pair(199, 60), std::pair(100, 110), std::pair(150, 110)));
}

TEST(StreetGraph, AStreetGoesOnAlongItsName) {
  KnownStreets map;
  map.street({0, 60}, {80, 60}, 5.0);
  map.cover(81, 160);
  EXPECT_THAT(places_of_degree(map.joined(), 1), UnorderedElementsAre(std::pair(0, 60), std::pair(80, 60)));
  EXPECT_THAT(places_of_degree(map.joined({level_name(84, 150, 60, 10.0)}), 1),
              UnorderedElementsAre(std::pair(0, 60), std::pair(150, 60)));
  // Beside the street by more than 0.6 of its height.
  EXPECT_THAT(places_of_degree(map.joined({level_name(84, 150, 70, 10.0)}), 1),
              UnorderedElementsAre(std::pair(0, 60), std::pair(80, 60)));
}

TEST(StreetGraph, StreetsReachThePicturesBorder) {
  KnownStreets map;
  map.street({5, 60}, {192, 60}, 5.0);
  EXPECT_THAT(places_of_degree(map.joined(), 1), UnorderedElementsAre(std::pair(0, 60), std::pair(199, 60)));
}

TEST(StreetGraph, PathsMeetStreetsAndLonePathsAreLeftOut) {
  KnownStreets map;
  map.street({0, 60}, {199, 60}, 5.0);
  const auto paths_in = [](const CentreLines& graph) {
    return std::count_if(graph.lines.begin(), graph.lines.end(),
                         [](const CentreLine& line) { return line.kind == MapStreet::Kind::path; });
  };
  const CentreLines graph = map.joined_with_path({100, 120}, {100, 70});
  EXPECT_EQ(graph.lines.size(), 3U);
  EXPECT_EQ(paths_in(graph), 1);
  EXPECT_THAT(places_of_degree(graph, 3), UnorderedElementsAre(std::pair(100, 60)));
  EXPECT_EQ(paths_in(map.joined_with_path({100, 120}, {160, 110})), 0);
  EXPECT_EQ(paths_in(map.joined_with_path({100, 120}, {199, 120})), 1);
}

}  // namespace
}  // namespace palpable::vision
