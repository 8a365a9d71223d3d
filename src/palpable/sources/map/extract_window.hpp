// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/map/map_extract.hpp"

#include <optional>
#include <vector>

namespace palpable::sources {

/// What else of an extract a map shows, for people on foot. Sidewalks and steps are lines beside streets,
/// crossings, entrances and stops (of buses and trams) are places.
struct ExtractLayers {
  bool sidewalks = false;
  bool crossings = false;
  bool steps = false;
  bool entrances = false;
  bool stops = false;
};

/// The layers that a finger has room for: stops up to a width of 1000 m, steps and crossings up to 300 m.
ExtractLayers usual_layers(double width_m);

/// Which part of an extract becomes a map: a square with north at its top.
struct ExtractWindow {
  /// If it is not given: the street's place that is nearest to the median of all.
  std::optional<GeoPoint> center;
  /// Length of a side, 50 ... 20 000 m.
  double width_m = 600.0;
  /// Pixels of the map on a side, 64 ... 8192. They only give the scale of its positions.
  int side_px = 1024;
  /// nullopt: usual_layers().
  std::optional<ExtractLayers> layers;
};

/// The map of a window, and notes for the user about it.
struct WindowMap {
  StreetMap map;
  std::vector<Note> notes;
};

/// The kinds of ways that are streets of a map to touch: for cars, and for pedestrians alone if they have a
/// name. Footpaths, cycle ways, tracks, unnamed service ways and railways are none; sidewalks and steps if
/// their layer is asked for.
bool is_street(const ExtractWay& way, const ExtractLayers& layers = {});

/// Width of a way: as stated, else what is usual for its kind, metres.
double width_m_of(const ExtractWay& way);

/// The streets, junctions and areas in a window, without any recognition: streets are divided where they meet
/// and have the extract's names. Special buildings and roundabouts are its places, with those of the layers;
/// several of one kind that are near each other and do not differ in their names are one. Errors, without a
/// place: usage for values out of range and a centre outside the extract; invalid_input for an extract
/// without streets, or none in the window.
Result<WindowMap> street_map_of(const MapExtract& extract, const ExtractWindow& window);

}  // namespace palpable::sources
