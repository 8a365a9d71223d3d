// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/map_words.hpp"
#include "palpable/models/scene/scene.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace palpable::describe {

struct MapTextOptions {
  /// Junctions beyond this number are counted only. 0 ... 10 000.
  std::size_t most_junctions = 60;
};

/// A street map in words to read or to hear, UTF-8, one sentence or item a line: its title and scale; each
/// street with its key (name_keys.hpp), length, direction and what it meets, in order along it, those that
/// cannot be felt last under a heading; junctions
/// with the bearings of their streets; places, water and buildings. The scene must have a map.
std::string map_text(const models::Scene& scene, const MapTextOptions& options = {});

/// Every street with a name, the longest first, and its key (name_keys.hpp): those of the text and of all
/// drawings.
struct KeyedStreet {
  std::string name;
  std::string key;
};
std::vector<KeyedStreet> keyed_streets(const models::Scene& scene);

/// Its first lines: title, scale, and how much it shows.
std::string map_heading(const models::Scene& scene, const MapGuide& guide);

/// A street of the map: length, direction, and what it meets in order. Without its key.
std::string street_words(const MapGuide& guide, const models::NamedStreet& street);

/// The streets that leave a node with their bearings: "Mill Lane north, High Street east and west". Where two
/// of them have one word, with degrees.
std::string bearings_words(const MapGuide& guide, std::size_t node);

}  // namespace palpable::describe
