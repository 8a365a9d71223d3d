// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace palpable {

/// A point of a map, in pixels of its picture: x right, y down, pixel centres at integers. A map without a
/// picture (from an extract) has pixels of its own.
struct MapPoint {
  double x = 0.0;
  double y = 0.0;
};

/// A piece of a street between two junctions or ends. A street with branches, or in several pieces, is
/// several of these with the same name.
struct MapStreet {
  /// As it is written, UTF-8; empty if it was not read.
  std::string name;
  double width_px = 0.0;
  /// The centre line, at least two points.
  std::vector<MapPoint> points;
  /// Whether it is felt in the scene; otherwise a finger could not tell it from its neighbours.
  bool felt = true;
  /// What it is for: a street, a path beside one, stairs, or a track or path of its own.
  enum class Kind : std::uint8_t { street, sidewalk, steps, path };
  Kind kind = Kind::street;
};

/// A place where three or more pieces of streets meet.
struct MapJunction {
  MapPoint at;
  /// How many pieces begin there.
  int degree = 0;
  bool roundabout = false;
};

/// An area of one kind, by its outline.
struct MapArea {
  enum class Kind : std::uint8_t { building, water, green };
  Kind kind = Kind::building;
  /// The outer ring, not repeating its first point.
  std::vector<MapPoint> outline;
};

/// A place that is more than a name: a special building, a roundabout, or a detail for people on foot.
struct MapPlace {
  enum class Kind : std::uint8_t {
    church,
    mosque,
    synagogue,
    temple,
    station,
    hospital,
    school,
    town_hall,
    museum,
    library,
    theatre,
    roundabout,
    bus_stop,
    tram_stop,
    crossing,
    entrance
  };
  Kind kind = Kind::church;
  /// As it is written, UTF-8; empty if it has none.
  std::string name;
  MapPoint at = {};
  /// The building's outline, or the ring of a roundabout; empty for others, and where it is not known.
  std::vector<MapPoint> outline = {};
  /// A crossing whose kerbs can be felt with a cane.
  bool tactile_paving = false;
  /// Whether it is felt in the scene; otherwise there is no room for it.
  bool felt = true;
};

/// Words that the map shows.
struct MapLabel {
  std::string text;
  /// 0 ... 1.
  double confidence = 0.0;
  /// Direction in which it is read, degrees, counted from the x axis clockwise (y is down), -180 ... 180.
  double angle_deg = 0.0;
  /// The four corners of its box, beginning with the top left corner of the words.
  std::vector<MapPoint> box;
  /// Whether it is the name of a street; otherwise that of a place.
  bool names_street = false;
};

/// What a street map shows. A value type; any thread.
struct StreetMap {
  /// Size of the picture that the points refer to.
  int width_px = 0;
  int height_px = 0;
  /// Metres of the world to a pixel; 0 if it is not known. Where it is known, north is up.
  double metres_per_px = 0.0;
  std::vector<MapStreet> streets;
  std::vector<MapJunction> junctions;
  std::vector<MapArea> areas;
  std::vector<MapLabel> labels;
  std::vector<MapPlace> places;
};

}  // namespace palpable
