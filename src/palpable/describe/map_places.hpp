// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/map_words.hpp"
#include "palpable/describe/named_place.hpp"

#include <cstddef>
#include <string>
#include <vector>

// Special places, and the words of a map that are no street's, in words.
namespace palpable::describe {

/// The special places of a map, then the words on it that are neither a street's name nor that of a special
/// place, then what persons named.
std::vector<NamedPlace> named_places(const MapGuide& guide);

/// The special place at a probe: a building around it, or another place within reach of it; nullptr if there
/// is none.
const MapPlace* place_at(const MapGuide& guide, MapPoint at);

/// What a special place is called: "St Mary, church".
std::string place_words(const MapPlace& place);

/// The special places in one sentence: "Special places: St Mary, church, upper left; …". Buildings and
/// roundabouts, at most `most` of them; empty if there are none.
std::string special_places_words(const MapGuide& guide, std::size_t most);

/// The same for the text of a map, one place a line, with stops; then how many crossings and entrances there
/// are. Empty if there are none.
std::string special_places_text(const MapGuide& guide);

}  // namespace palpable::describe
