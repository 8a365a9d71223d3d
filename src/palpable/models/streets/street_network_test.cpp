// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/streets/street_network.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

/// A square of 100 px: Top, Right, Bottom and Left Street, with Diagonal Road from its upper left corner to
/// the lower right one, in two pieces.
std::shared_ptr<const StreetMap> square() {
  StreetMap map;
  map.width_px = map.height_px = 120;
  map.streets = {
      {"Top Street", 4.0, {{10, 10}, {110, 10}}},      {"Right Street", 4.0, {{110, 110}, {110, 10}}},
      {"Bottom Street", 4.0, {{10, 110}, {110, 110}}}, {"Left Street", 4.0, {{10, 10}, {10, 110}}},
      {"Diagonal Road", 4.0, {{10, 10}, {60, 60}}},    {"Diagonal Road", 4.0, {{110, 110}, {60, 60}}}};
  return std::make_shared<const StreetMap>(map);
}

TEST(StreetNetwork, JoinsEndsAndSortsThemByBearing) {
  const StreetNetwork network(square());
  ASSERT_EQ(network.nodes().size(), 5U);
  const StreetNode& corner = network.nodes()[network.first_node(0)];
  ASSERT_EQ(corner.pieces.size(), 3U);
  EXPECT_EQ(corner.pieces[0], 0U);
  EXPECT_NEAR(corner.bearings[0], 0.5 * std::numbers::pi, 1e-9);
  EXPECT_EQ(corner.pieces[1], 4U);
  EXPECT_NEAR(corner.bearings[1], 0.75 * std::numbers::pi, 1e-9);
  EXPECT_EQ(corner.pieces[2], 3U);
}

TEST(StreetNetwork, TakesBearingsOverALength) {
  StreetMap map;
  map.width_px = map.height_px = 100;
  // Two pixels to the right, then up.
  map.streets = {{"Hook Lane", 4.0, {{50, 80}, {52, 80}, {52, 20}}}};
  const auto bearing_over = [&](double length_px) {
    const StreetNetwork network(std::make_shared<const StreetMap>(map), {.bearing_px = length_px});
    return network.nodes()[network.first_node(0)].bearings[0];
  };
  EXPECT_NEAR(bearing_over(1.0), 0.5 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(bearing_over(12.0), std::atan2(2.0, 10.0), 1e-9);
}

TEST(StreetNetwork, FindsTheNearestPlace) {
  const StreetNetwork network(square());
  const auto at = network.nearest({50, 15}, 20.0);
  ASSERT_TRUE(at);
  EXPECT_EQ(at->piece, 0U);
  EXPECT_NEAR(at->along_px, 40.0, 1e-9);
  EXPECT_NEAR(at->distance_px, 5.0, 1e-9);
  EXPECT_FALSE(network.nearest({60, 35}, 10.0));
}

TEST(StreetNetwork, TakesTheShortestRoute) {
  const StreetNetwork network(square());
  const auto from = network.nearest({30, 10}, 1.0), to = network.nearest({110, 105}, 1.0);
  ASSERT_TRUE(from && to);
  const auto route = network.route(*from, *to);
  ASSERT_TRUE(route);
  // 20 back to the corner, the diagonal, 5 up; round the outside it is 80 + 95.
  EXPECT_NEAR(route->length_px, 20.0 + 100.0 * std::numbers::sqrt2 + 5.0, 1e-9);
  ASSERT_EQ(route->legs.size(), 3U);
  EXPECT_EQ(route->legs[0].name, "Top Street");
  EXPECT_EQ(route->legs[1].name, "Diagonal Road");
  EXPECT_NEAR(route->legs[1].first_bearing, 0.75 * std::numbers::pi, 1e-9);
  EXPECT_EQ(route->legs[2].name, "Right Street");
  EXPECT_NEAR(route->line.back().y, 105.0, 1e-9);
  EXPECT_NEAR(length_px_of(route->line), route->length_px, 1e-9);
}

TEST(StreetNetwork, GoesAlongOnePieceAndNotBetweenIslands) {
  StreetMap map = *square();
  map.streets.push_back({"Far Lane", 4.0, {{115, 20}, {115, 100}}});
  const StreetNetwork network(std::make_shared<const StreetMap>(map));
  const auto a = network.nearest({30, 10}, 1.0), b = network.nearest({90, 10}, 1.0),
             far = network.nearest({115, 50}, 1.0);
  ASSERT_TRUE(a && b && far);
  EXPECT_NEAR(network.route(*b, *a)->length_px, 60.0, 1e-9);
  EXPECT_FALSE(network.route(*a, *far));
}

/// Every part of a route lies on a street, and none is shorter than it is by steps of the network.
TEST(StreetNetwork, RoutesAreSymmetric) {
  const StreetNetwork network(square());
  std::mt19937 random(7);
  std::uniform_real_distribution<> within(10.0, 110.0);
  for (int i = 0; i < 50; ++i) {
    const auto a = network.nearest({within(random), within(random)}, 100.0);
    const auto b = network.nearest({within(random), within(random)}, 100.0);
    const auto there = network.route(*a, *b), back = network.route(*b, *a);
    ASSERT_TRUE(there && back);
    EXPECT_NEAR(there->length_px, back->length_px, 1e-9);
    for (const MapPoint p : there->line) EXPECT_TRUE(network.nearest(p, 1e-6));
  }
}

TEST(StreetNetwork, JoinsStreetsByNameAndSetsCarriagewaysAside) {
  StreetMap map;
  map.width_px = map.height_px = 200;
  // Two carriageways of Main Road, and a piece of it with another direction beyond the crossing.
  map.streets = {{"Main Road", 4.0, {{0, 100}, {100, 100}}},
                 {"Main Road", 4.0, {{100, 100}, {199, 90}}},
                 {"Main Road", 4.0, {{0, 108}, {190, 108}}},
                 {"Mill Lane", 4.0, {{100, 100}, {100, 0}}}};
  const StreetNetwork network(std::make_shared<const StreetMap>(map));
  const auto streets = network.named_streets(20.0);
  ASSERT_EQ(streets.size(), 2U);
  EXPECT_EQ(streets[0].name, "Main Road");
  EXPECT_TRUE(streets[0].two_carriageways);
  ASSERT_EQ(streets[0].runs.size(), 1U);
  EXPECT_NEAR(streets[0].length_px, 100.0 + std::hypot(99.0, 10.0), 1e-9);
  EXPECT_EQ(streets[0].runs[0].nodes.size(), 3U);
  EXPECT_FALSE(streets[1].two_carriageways);
}

TEST(StreetNetwork, ARingIsOneRun) {
  StreetMap map;
  map.width_px = map.height_px = 100;
  map.streets = {{"Circus", 4.0, {{20, 20}, {80, 20}, {80, 80}}},
                 {"Circus", 4.0, {{80, 80}, {20, 80}, {20, 20}}}};
  const StreetNetwork network(std::make_shared<const StreetMap>(map));
  const auto streets = network.named_streets(5.0);
  ASSERT_EQ(streets.size(), 1U);
  ASSERT_EQ(streets[0].runs.size(), 1U);
  EXPECT_EQ(streets[0].runs[0].nodes.front(), streets[0].runs[0].nodes.back());
  EXPECT_NEAR(streets[0].length_px, 240.0, 1e-9);
}

}  // namespace
}  // namespace palpable::models
