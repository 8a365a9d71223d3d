// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/map_words.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/models/streets/street_network.hpp"

#include <string>
#include <vector>

// A simulated hand that follows a spoken route over a map. It is a model and no evidence about people.
namespace palpable::bench {

/// A leg as it is spoken: its street, one of eight directions, and a rounded length.
struct SpokenLeg {
  /// As it is heard: "street" or "steps" without a name.
  std::string name;
  /// Radians clockwise from up, a multiple of 45 degrees.
  double direction = 0.0;
  double length_m = 0.0;
  /// Where the route ends, for its last leg: the hand hears it within FollowerOptions::end_m
  /// (describe::is_at_route_end()).
  describe::Place end;
  bool is_last = false;
};

/// What a listener knows of a route: its legs without their exact bearings and lengths.
std::vector<SpokenLeg> spoken_legs(const describe::MapGuide& guide, const models::StreetRoute& route);

struct FollowerOptions {
  /// Steps of the finger, and how far it feels around itself. 0.1 ... 5 mm; 2 ... 10 mm.
  double step_m = 0.0005;
  double reach_m = 0.004;
  /// How far beyond the spoken length a turn is looked for before the hand goes back, m on the device.
  double overshoot_m = 0.010;
  /// How near to the end of the route it is heard.
  double end_m = 0.003;
};

/// Where the hand ends that begins at a place and knows the spoken legs. It senses heights of the relief
/// under and within reach of the finger, and the names that are spoken there, that of the route's end
/// included; nothing else.
describe::Place follow_route(const models::Scene& scene, describe::Place start,
                             const std::vector<SpokenLeg>& legs, const FollowerOptions& options);

}  // namespace palpable::bench
