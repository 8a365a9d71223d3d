// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace palpable::sources {

/// A place on the Earth, WGS 84, degrees: latitude -90 ... 90, longitude -180 ... 180.
struct GeoPoint {
  double latitude = 0.0;
  double longitude = 0.0;
};

/// A street, a way or a railway of an extract.
struct ExtractWay {
  /// The value of the key `highway`, as "residential"; "rail" for railways, "sidewalk" for the footways that
  /// are tagged as one or as the crossing between two.
  std::string kind;
  /// UTF-8; empty if the extract has none.
  std::string name;
  /// As the extract states it; 0 if it does not.
  double width_m = 0.0;
  bool tunnel = false;
  bool roundabout = false;
  /// The extract's numbers of the nodes, and where they are: one for one, at least two. Ways that share a
  /// node meet there.
  std::vector<std::int64_t> nodes;
  std::vector<GeoPoint> points;
};

/// An area of an extract.
struct ExtractArea {
  enum class Kind : std::uint8_t { building, water, green };
  Kind kind = Kind::building;
  /// The outer ring, not repeating its first point; at least three.
  std::vector<GeoPoint> ring;
};

/// A church, a station, a bus stop …: a node or an area.
struct ExtractPlace {
  MapPlace::Kind kind = MapPlace::Kind::church;
  std::string name;
  /// Of an area its middle.
  GeoPoint at;
  /// The outer ring of a building; empty for nodes and for grounds.
  std::vector<GeoPoint> ring;
  bool tactile_paving = false;
};

/// What a street map needs of an OpenStreetMap extract. A value type; any thread.
struct MapExtract {
  std::vector<ExtractWay> ways;
  std::vector<ExtractArea> areas;
  std::vector<ExtractPlace> places;
};

/// Reads an OpenStreetMap extract, `.osm` (XML) or `.osm.pbf`, by its content. It is parsed in the decoder
/// process (isolated/isolated.hpp). Ways are divided at nodes that are not in the extract. Errors:
/// invalid_input, naming the file, for an unreadable or damaged file.
Result<MapExtract> read_map_extract(const std::filesystem::path& path);

}  // namespace palpable::sources
