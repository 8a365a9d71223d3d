// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/models/streets/street_network.hpp"

#include <memory>
#include <string>
#include <vector>

namespace palpable::describe {

/// Which streets of a map: all of them, or those that are felt in the scene.
enum class MapStreets { all, felt };

/// A map scene and its network, with what words about it need. The scene must have a map. Immutable; any
/// thread.
class MapGuide {
 public:
  explicit MapGuide(const models::Scene& scene, MapStreets streets = MapStreets::all);

  const models::StreetNetwork& network() const noexcept { return network_; }
  const StreetMap& map() const noexcept { return network_.map(); }

  /// From places of the scene to pixels of the map and back.
  MapPoint pixel_of(Place place) const;
  Place place_of(MapPoint pixel) const;
  double pixels_of(double scene_m) const { return scene_m / scene_m_per_px_; }
  double metres_on_device(double px) const { return px * scene_m_per_px_; }

  /// A distance to hear: metres of the world, rounded to 5 or 10, or millimetres on the device where the
  /// map's scale is not known.
  std::string distance_words(double px) const;
  /// A direction in eight words: "north-east" on a map whose north is known, else "up and right".
  std::string direction_words(double bearing) const;
  /// Where on the map: "upper left".
  std::string region_of(MapPoint pixel) const;
  /// Whether a place is at the map's edge.
  bool is_at_edge(MapPoint pixel) const;

  /// What persons named on the map.
  const models::PlaceNames& written() const noexcept { return written_; }

  /// Every street with a name, the longest first.
  const std::vector<models::NamedStreet>& streets() const noexcept { return streets_; }
  /// Names of the map's streets that are not among streets(): no piece of them is felt. Empty with
  /// MapStreets::all.
  const std::vector<std::string>& missing_names() const noexcept { return missing_names_; }
  /// The names of the streets at a node, each once, in alphabetical order; without unnamed ones.
  std::vector<std::string> names_at(std::size_t node) const;

 private:
  models::StreetNetwork network_;
  double scene_m_per_px_ = 0.0;
  models::PlaceNames written_;
  std::vector<models::NamedStreet> streets_;
  std::vector<std::string> missing_names_;
};

/// How a street without a name is called.
inline constexpr const char* kUnnamedStreet = "a street without a name";

/// How a street with this name is called: its name, else what it is ("steps", "a sidewalk").
std::string called(const std::string& name, MapStreet::Kind kind);
inline std::string called(const MapStreet& street) { return called(street.name, street.kind); }

}  // namespace palpable::describe
