// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace palpable {

/// How a kind of place is written in files ("bus_stop") and said ("bus stop").
std::string_view name_of(MapPlace::Kind kind);
std::string_view words_of(MapPlace::Kind kind);
/// "street", "sidewalk" or "steps".
std::string_view kind_words(MapStreet::Kind kind);
/// The kind with this name in files; nullopt for another one.
std::optional<MapPlace::Kind> map_place_kind_from(std::string_view name);

/// Whether it is a building that is felt as a special one, with its own height and texture.
bool is_special_building(MapPlace::Kind kind);

/// The kind that a place's name tells in English, French, German, Italian or Spanish: "St Mary's Church",
/// "Hauptbahnhof", "Gare du Nord"; nullopt if it tells none, and for names of streets ("Church Road").
std::optional<MapPlace::Kind> map_place_kind_in(std::string_view place_name);

/// Whether the first or last word of a name is that of a street in these languages: "Mill Lane", "Rue Plati",
/// "Landstrasse".
bool is_street_name(std::string_view name);

/// A place as it is said: "Infirmary Street, bus stop", "crossing with tactile paving"; a name that tells the
/// kind is said alone.
std::string words_of(const MapPlace& place);

}  // namespace palpable
