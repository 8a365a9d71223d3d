// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::models {

/// A place where pieces of streets begin, end or meet.
struct StreetNode {
  MapPoint at;
  /// The pieces, as indices of StreetMap::streets, in the order of their bearings; a loop is listed twice.
  std::vector<std::size_t> pieces;
  /// Bearing of each piece where it leaves the node, radians clockwise from up, 0 ... 2 pi.
  std::vector<double> bearings;
  bool roundabout = false;
};

/// A place on a street.
struct StreetPosition {
  /// Index of StreetMap::streets.
  std::size_t piece = 0;
  /// Distance from the piece's first point along it.
  double along_px = 0.0;
  MapPoint at;
  /// From the place that was asked for.
  double distance_px = 0.0;
};

/// A part of a route along streets of one name.
struct RouteLeg {
  /// Empty if the street has none.
  std::string name;
  MapStreet::Kind kind = MapStreet::Kind::street;
  double length_px = 0.0;
  /// Bearings where it begins and ends, radians clockwise from up.
  double first_bearing = 0.0;
  double last_bearing = 0.0;
  /// Index of its first point in StreetRoute::line.
  std::size_t first_point = 0;
};

/// The shortest way along streets from a place to another one.
struct StreetRoute {
  /// At least two points.
  std::vector<MapPoint> line;
  std::vector<RouteLeg> legs;
  double length_px = 0.0;
};

/// A street of one name without branches: pieces that continue each other straight ahead.
struct StreetRun {
  std::vector<MapPoint> line;
  double length_px = 0.0;
  /// The nodes on it in its order, with their distances from its first point. The first and last are its
  /// ends.
  std::vector<std::size_t> nodes;
  std::vector<double> along_px;
  std::vector<std::size_t> pieces;
};

/// All of a street, without parts that lie beside others (a second carriageway).
struct NamedStreet {
  std::string name;
  /// Without the parts beside.
  double length_px = 0.0;
  bool two_carriageways = false;
  /// The longest first.
  std::vector<StreetRun> runs;
};

/// When pieces of streets hang together, and are one street. Initial values, not tuned.
struct StreetNetworkOptions {
  /// Ends that are at most this far apart are one node, pixels. 0 ... 50.
  double join_px = 2.0;
  /// Bearings are taken over this length, pixels, so that a short first segment does not count. 1 ... 200.
  double bearing_px = 12.0;
  /// A street goes on, over a node, to the piece of its name that turns least, and by less than this,
  /// degrees. 0
  /// ... 180.
  double most_turn_deg = 135.0;
  /// A part of a street is its second carriageway if this part of it has another one beside it. 0 ... 1.
  double beside_part = 0.7;
};
std::vector<Parameter> parameters_of(StreetNetworkOptions& options);

/// How pieces of streets hang together. Immutable; any thread.
class StreetNetwork {
 public:
  /// `map` must not be null, and the options must be in range.
  explicit StreetNetwork(std::shared_ptr<const StreetMap> map, const StreetNetworkOptions& options = {});

  const StreetMap& map() const noexcept { return *map_; }
  const std::vector<StreetNode>& nodes() const noexcept { return nodes_; }
  /// The nodes at the first and the last point of a piece.
  std::size_t first_node(std::size_t piece) const { return ends_[piece].first; }
  std::size_t last_node(std::size_t piece) const { return ends_[piece].second; }
  double length_px(std::size_t piece) const { return lengths_px_[piece]; }

  /// The nearest place on a street; nullopt if none is within `reach_px`.
  std::optional<StreetPosition> nearest(MapPoint place, double reach_px) const;

  /// The shortest route (Dijkstra 1959); nullopt if the places are not connected.
  std::optional<StreetRoute> route(const StreetPosition& from, const StreetPosition& to) const;

  /// Every street with a name, the longest first. Parts of a street within `beside_px` of another part of it
  /// for `beside_part` of their length count as its second carriageway.
  std::vector<NamedStreet> named_streets(double beside_px) const;

 private:
  std::size_t node_at(MapPoint at);
  /// Bearing with which a line leaves its first point.
  double first_bearing(const std::vector<MapPoint>& line) const;
  void set_bearings(StreetRoute& route) const;
  bool is_beside(const std::vector<MapPoint>& line, const std::vector<MapPoint>& other,
                 double beside_px) const;
  StreetRun run_from(std::size_t piece, std::size_t from, std::vector<bool>& used) const;
  std::size_t other_end(std::size_t piece, std::size_t node) const;
  struct Ways;
  Ways ways_from(const StreetPosition& from) const;
  /// Adds the legs of the way over nodes, which reaches the last piece at its first or last point.
  void add_way(const Ways& ways, const StreetPosition& from, const StreetPosition& to, bool by_first,
               StreetRoute& route) const;

  std::shared_ptr<const StreetMap> map_;
  StreetNetworkOptions options_;
  std::vector<StreetNode> nodes_;
  std::vector<std::pair<std::size_t, std::size_t>> ends_;
  std::vector<double> lengths_px_;
};

/// The map with the streets that are felt alone.
std::shared_ptr<const StreetMap> felt_part(const StreetMap& map);

/// The names of streets of which no piece is felt, each once, in alphabetical order.
std::vector<std::string> unfelt_names(const StreetMap& map);

/// Bearing from a point to another one, radians clockwise from up, 0 ... 2 pi; 0 for the same point.
double bearing_of(MapPoint from, MapPoint to);

/// Length of a line.
double length_px_of(const std::vector<MapPoint>& line);

/// The place of a line, of at least two points, that is nearest to a point.
MapPoint nearest_on(const std::vector<MapPoint>& line, MapPoint p);

/// The place at a distance from the first point of a line; its ends outside of it.
MapPoint place_along(const std::vector<MapPoint>& line, double along_px);

}  // namespace palpable::models
