// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/text/read_text.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

struct MapWordsOptions {
  /// Words with which different names of the map begin or end ("Rue", "Street") and endings that different
  /// words of it have in common ("weg") are its own if at least this many names, read with at least this
  /// confidence, have them. 2 ... 100 and 0 ... 1.
  int fewest_names = 3;
  double least_confidence = 0.8;
  /// Letters of an ending. 2 ... 20.
  int least_ending = 3;
};
std::vector<Parameter> parameters_of(MapWordsOptions& options);

/// Words with which names begin or end, and endings of words, become those of the map's own that differ from
/// them by one letter ("Kue Grimaldi", "KornweS"). The map's own words are left, as are those of which more
/// than one is as near. `read` belongs to all lines of lettering of the map. Any thread.
void correct_by_map_words(std::span<ReadLine> read, const MapWordsOptions& options = {});

}  // namespace palpable::vision
