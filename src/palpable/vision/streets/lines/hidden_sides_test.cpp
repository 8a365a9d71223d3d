// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/hidden_sides.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr double kMiddle = 46.5;

/// A street in the rows 40 to 53, of which the rows to 47 are hidden between x = 150 and 250, and the line in
/// the middle of what can be seen of it.
struct HalfHidden {
  Raster<std::uint8_t> mask{400, 100};
  Raster<std::uint8_t> others{400, 100};
  CentreLines graph;

  explicit HalfHidden(int from = 150, int to = 250) {
    CentreLine line{{}, 0, 1, 7.0, 0.1};
    for (int x = 0; x < 400; ++x) {
      const bool is_hidden = x >= from && x <= to;
      for (int y = 30; y <= 53; ++y) {
        mask(x, y) = y >= (is_hidden ? 48 : 40) ? 1 : 0;
        others(x, y) = is_hidden && y < 48 ? 1 : 0;
      }
      line.points.push_back({static_cast<double>(x), is_hidden ? 50.5 : kMiddle});
    }
    graph.nodes = {line.points.front(), line.points.back()};
    graph.lines = {line};
  }
  double farthest() const {
    double most = 0.0;
    for (const MapPoint p : graph.lines.front().points)
      most = std::max(
          most, std::abs(p.x - 150.0) < 10.0 || std::abs(p.x - 250.0) < 10.0 ? 0.0 : std::abs(p.y - kMiddle));
    return most;
  }
};

TEST(HiddenSides, TheLineIsMovedToTheMiddleOfTheWholeStreet) {
  HalfHidden street;
  EXPECT_GT(street.farthest(), 3.5);
  centre_hidden_sides(street.graph, street.mask, street.others);
  EXPECT_LT(street.farthest(), 1.0);
}

TEST(HiddenSides, ANarrowStreetBesideLandStaysWhereItIs) {
  HalfHidden street;
  const auto before = street.graph.lines.front().points;
  centre_hidden_sides(street.graph, street.mask, Raster<std::uint8_t>(400, 100));
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(street.graph.lines.front().points[i].y, before[i].y);
}

TEST(HiddenSides, AStreetThatIsHiddenAllAlongHasAWidthOfItsColour) {
  HalfHidden hidden(0, 399);
  CentreLine other{{}, 2, 3, 7.0, 0.1};
  for (int x = 0; x < 400; ++x) {
    for (int y = 70; y < 84; ++y) hidden.mask(x, y) = 1;
    other.points.push_back({static_cast<double>(x), 76.5});
  }
  hidden.graph.nodes.push_back(other.points.front());
  hidden.graph.nodes.push_back(other.points.back());
  hidden.graph.lines.push_back(other);
  centre_hidden_sides(hidden.graph, hidden.mask, hidden.others);
  EXPECT_LT(hidden.farthest(), 1.0);
}

}  // namespace
}  // namespace palpable::vision
