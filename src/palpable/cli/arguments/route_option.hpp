// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <string>
#include <vector>

namespace palpable::cli {

/// Friction of the streets of a route and of the others, static and sliding. Friction only takes energy from
/// the hand, so that the route guides without pushing.
struct RouteFriction {
  double on_route = 0.05;
  double elsewhere = 0.6;
};

/// How a route guides the hand.
struct RouteGuidance {
  RouteFriction friction;
  /// Greatest pull along it, 0 ... 1 N; 0: friction alone.
  double pull_N = 0.5;
};

/// Finds the shortest route "A to B" (describe/map_route_words.hpp) along the streets that are felt: its
/// streets become smooth and all others rough, the scene gets a guide along it, and its sentences are added
/// to the scene's description, where they are heard again on request. Returns the sentences. Errors: usage
/// for a scene without a map, unknown places, and places that no felt streets connect.
Result<std::vector<std::string>> apply_route(const std::string& route, const RouteGuidance& guidance,
                                             models::Scene& scene);

}  // namespace palpable::cli
