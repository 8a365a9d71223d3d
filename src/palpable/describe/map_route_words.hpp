// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/describe/map_words.hpp"

#include <string>
#include <vector>

// Places on a map in words, and routes between them.
namespace palpable::describe {

/// Where a place is: on which street between which others, at which junction, or how far from the nearest
/// street.
std::string map_position_words(const MapGuide& guide, Place place);

/// What is around a place: the nearest other streets and places with direction and distance.
std::string around_words(const MapGuide& guide, Place place);

/// A map in parts, from short to long, as scene_words.hpp gives them: what it shows; what is around the
/// probe; its longest streets.
std::vector<std::string> map_parts(const models::Scene& scene, Place probe);

/// A place by name: a street ("High Street": its middle), a junction ("High Street & Mill Lane"), or a place.
/// Case does not count; a name that only one street begins with or is spelled nearly like is enough. A whole
/// name is tried before its signs divide it. Errors: usage for a name that nothing has, with the names
/// similar to it; for one that several have, with these; for a street that is not felt, and for one street
/// twice.
Result<models::StreetPosition> find_on_map(const MapGuide& guide, const std::string& name);

/// The two ends of "A to B", where whole names that hold " to " count first. Errors: usage without a " to "
/// (in any case), for equal ends, or as find_on_map().
struct RouteEnds {
  models::StreetPosition from;
  models::StreetPosition to;
};
Result<RouteEnds> route_ends(const MapGuide& guide, const std::string& text);

/// When a route over streets that are felt is much longer than the shortest way: in both respects.
struct DetourOptions {
  /// Its length as a multiple of that of the shortest way, at least 1.
  double least_ratio = 1.5;
  /// How much longer: metres of the world, or on the device where the map's scale is not known.
  double least_more_m = 100.0;
  double least_more_on_device_m = 0.02;
};

/// "The shortest way, 240 metres, leads over streets that cannot be felt."; empty if the route is not much
/// longer. `all` has all streets of the map.
std::string detour_words(const MapGuide& all, const models::StreetRoute& route, const RouteEnds& ends,
                         const DetourOptions& options = {});

/// A route as it is spoken, one sentence for each leg and one for its end: "High Street, go east for 120
/// metres.", "Turn left into Mill Lane, go north for 200 metres.", "There is the end." A leg that ends in
/// another direction than it begins in: "go east, in the end north, for 120 metres".
std::vector<std::string> route_words(const MapGuide& guide, const models::StreetRoute& route);

}  // namespace palpable::describe
