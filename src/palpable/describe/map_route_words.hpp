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
/// Case does not count; a name that only one street begins with or is spelled nearly like is enough. Errors:
/// usage, naming what there is, for a name that nothing has.
Result<models::StreetPosition> find_on_map(const MapGuide& guide, const std::string& name);

/// The two ends of "A to B". Errors: usage without a " to ", or as find_on_map().
struct RouteEnds {
  models::StreetPosition from;
  models::StreetPosition to;
};
Result<RouteEnds> route_ends(const MapGuide& guide, const std::string& text);

/// A route as it is spoken, one sentence for each leg and one for its end: "High Street, go east for 120
/// metres.", "Turn left into Mill Lane, go north for 200 metres.", "There is the end."
std::vector<std::string> route_words(const MapGuide& guide, const models::StreetRoute& route);

}  // namespace palpable::describe
