// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/streets/street_network.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/geometry/segment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <set>
#include <utility>

namespace palpable::models {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

double distance_px(MapPoint a, MapPoint b) { return std::hypot(b.x - a.x, b.y - a.y); }

std::vector<MapPoint> reversed(std::vector<MapPoint> line) {
  std::reverse(line.begin(), line.end());
  return line;
}

/// The part of a line between two distances from its first point; backwards if the first one is larger.
std::vector<MapPoint> part_of(const std::vector<MapPoint>& line, double from_px, double to_px) {
  if (from_px > to_px) return reversed(part_of(line, to_px, from_px));
  std::vector<MapPoint> part{place_along(line, from_px)};
  double along = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    along += distance_px(line[i - 1], line[i]);
    if (along > from_px && along < to_px) part.push_back(line[i]);
  }
  part.push_back(place_along(line, to_px));
  return part;
}

/// 0 for straight ahead, pi for back.
double turn_between(double bearing, double next) {
  return std::abs(std::remainder(next - bearing, kFullTurn));
}

/// Adds a part of a route; parts of streets with one name are one leg.
void add_leg(StreetRoute& route, const MapStreet& street, const std::vector<MapPoint>& part) {
  const double length = length_px_of(part);
  if (length <= 0.0) return;
  if (route.legs.empty() || route.legs.back().name != street.name || route.legs.back().kind != street.kind)
    route.legs.push_back(
        {street.name, street.kind, 0.0, 0.0, 0.0, route.line.empty() ? 0 : route.line.size() - 1});
  route.legs.back().length_px += length;
  route.line.insert(route.line.end(), part.begin() + (route.line.empty() ? 0 : 1), part.end());
  route.length_px += length;
}

bool is_near(const std::vector<MapPoint>& line, MapPoint p, double reach_px) {
  return distance_px(nearest_on(line, p), p) <= reach_px;
}

}  // namespace

std::shared_ptr<const StreetMap> felt_part(const StreetMap& map) {
  StreetMap part = map;
  std::erase_if(part.streets, [](const MapStreet& street) { return !street.felt; });
  return std::make_shared<const StreetMap>(std::move(part));
}

std::vector<std::string> unfelt_names(const StreetMap& map) {
  std::set<std::string> names;
  for (const MapStreet& street : map.streets)
    if (!street.felt && !street.name.empty()) names.insert(street.name);
  for (const MapStreet& street : map.streets)
    if (street.felt) names.erase(street.name);
  return {names.begin(), names.end()};
}

double bearing_of(MapPoint from, MapPoint to) {
  if (from.x == to.x && from.y == to.y) return 0.0;
  const double bearing = std::atan2(to.x - from.x, from.y - to.y);
  return bearing < 0.0 ? bearing + kFullTurn : bearing;
}

double length_px_of(const std::vector<MapPoint>& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += distance_px(line[i - 1], line[i]);
  return sum;
}

MapPoint nearest_on(const std::vector<MapPoint>& line, MapPoint p) {
  MapPoint best = line.front();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const MapPoint a = line[i - 1], d{line[i].x - a.x, line[i].y - a.y};
    const double t = nearest_share(p, a, line[i]);
    const MapPoint at{a.x + t * d.x, a.y + t * d.y};
    if (distance_px(at, p) < distance_px(best, p)) best = at;
  }
  return best;
}

MapPoint place_along(const std::vector<MapPoint>& line, double along_px) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = distance_px(line[i - 1], line[i]);
    if (along_px <= length && length > 0.0) {
      const double t = std::max(0.0, along_px / length);
      return {line[i - 1].x + t * (line[i].x - line[i - 1].x),
              line[i - 1].y + t * (line[i].y - line[i - 1].y)};
    }
    along_px -= length;
  }
  return line.back();
}

std::vector<Parameter> parameters_of(StreetNetworkOptions& o) {
  return {{"join_px", &o.join_px, {0, 50}, "px", "ends this near are one node"},
          {"bearing_px", &o.bearing_px, {1, 200}, "px", "length over which a bearing is taken"},
          {"most_turn_deg", &o.most_turn_deg, {0, 180}, "degrees", "greatest turn of a street at a node"},
          {"beside_part", &o.beside_part, {0, 1}, "", "part of a second carriageway beside the first"}};
}

double StreetNetwork::first_bearing(const std::vector<MapPoint>& line) const {
  return bearing_of(line.front(), place_along(line, options_.bearing_px));
}

/// The bearings of the legs of a finished route: over the whole leg, so that a short piece at its end does
/// not count.
void StreetNetwork::set_bearings(StreetRoute& route) const {
  for (std::size_t k = 0; k < route.legs.size(); ++k) {
    const std::size_t last =
        k + 1 < route.legs.size() ? route.legs[k + 1].first_point : route.line.size() - 1;
    const auto begin = route.line.begin();
    const std::vector<MapPoint> line(begin + static_cast<std::ptrdiff_t>(route.legs[k].first_point),
                                     begin + static_cast<std::ptrdiff_t>(last) + 1);
    const double back = first_bearing(reversed(line));
    route.legs[k].first_bearing = first_bearing(line);
    route.legs[k].last_bearing = back < std::numbers::pi ? back + std::numbers::pi : back - std::numbers::pi;
  }
}

/// Whether enough of a line is near another one.
bool StreetNetwork::is_beside(const std::vector<MapPoint>& line, const std::vector<MapPoint>& other,
                              double beside_px) const {
  constexpr int kPlaces = 20;
  const double length = length_px_of(line);
  int near = 0;
  for (int i = 0; i < kPlaces; ++i)
    near += is_near(other, place_along(line, (i + 0.5) / kPlaces * length), beside_px) ? 1 : 0;
  return near >= options_.beside_part * kPlaces;
}

StreetNetwork::StreetNetwork(std::shared_ptr<const StreetMap> map, const StreetNetworkOptions& options)
    : map_(std::move(map)), options_(options) {
  PALPABLE_CHECK(check_ranges(options_));
  for (const MapStreet& street : map_->streets) {
    const std::size_t piece = ends_.size();
    lengths_px_.push_back(length_px_of(street.points));
    ends_.emplace_back(node_at(street.points.front()), node_at(street.points.back()));
    nodes_[ends_.back().first].pieces.push_back(piece);
    nodes_[ends_.back().first].bearings.push_back(first_bearing(street.points));
    nodes_[ends_.back().second].pieces.push_back(piece);
    nodes_[ends_.back().second].bearings.push_back(first_bearing(reversed(street.points)));
  }
  for (StreetNode& node : nodes_) {
    std::vector<std::size_t> order(node.pieces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&node](std::size_t a, std::size_t b) { return node.bearings[a] < node.bearings[b]; });
    const StreetNode unsorted = node;
    for (std::size_t k = 0; k < order.size(); ++k) {
      node.pieces[k] = unsorted.pieces[order[k]];
      node.bearings[k] = unsorted.bearings[order[k]];
    }
    for (const MapJunction& junction : map_->junctions)
      node.roundabout =
          node.roundabout || (junction.roundabout && distance_px(junction.at, node.at) <= options_.join_px);
  }
}

std::size_t StreetNetwork::node_at(MapPoint at) {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (distance_px(nodes_[i].at, at) <= options_.join_px) return i;
  nodes_.push_back({at, {}, {}, false});
  return nodes_.size() - 1;
}

std::optional<StreetPosition> StreetNetwork::nearest(MapPoint place, double reach_px) const {
  std::optional<StreetPosition> best;
  double least = reach_px;
  for (std::size_t piece = 0; piece < map_->streets.size(); ++piece) {
    const auto& line = map_->streets[piece].points;
    double along = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const MapPoint a = line[i - 1], d{line[i].x - a.x, line[i].y - a.y};
      const double length = std::sqrt(d.x * d.x + d.y * d.y), t = nearest_share(place, a, line[i]);
      const MapPoint at{a.x + t * d.x, a.y + t * d.y};
      if (const double distance = distance_px(at, place); distance <= least) {
        least = distance;
        best = StreetPosition{piece, along + t * length, at, distance};
      }
      along += length;
    }
  }
  return best;
}

/// The shortest ways from a position to all nodes (Dijkstra 1959).
struct StreetNetwork::Ways {
  std::vector<double> length_px;
  /// The piece by which each node is reached; kNone for the ends of the first piece.
  std::vector<std::size_t> by;
};

StreetNetwork::Ways StreetNetwork::ways_from(const StreetPosition& from) const {
  using Entry = std::pair<double, std::size_t>;
  Ways ways{std::vector<double>(nodes_.size(), std::numeric_limits<double>::infinity()),
            std::vector<std::size_t>(nodes_.size(), kNone)};
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](std::size_t node, double length, std::size_t piece) {
    if (length >= ways.length_px[node]) return;
    ways.length_px[node] = length;
    ways.by[node] = piece;
    open.emplace(length, node);
  };
  reach(ends_[from.piece].first, from.along_px, kNone);
  reach(ends_[from.piece].second, lengths_px_[from.piece] - from.along_px, kNone);
  while (!open.empty()) {
    const auto [length, node] = open.top();
    open.pop();
    if (length > ways.length_px[node]) continue;
    for (const std::size_t piece : nodes_[node].pieces)
      reach(other_end(piece, node), length + lengths_px_[piece], piece);
  }
  return ways;
}

std::size_t StreetNetwork::other_end(std::size_t piece, std::size_t node) const {
  const auto [a, b] = ends_[piece];
  return a == node ? b : a;
}

std::optional<StreetRoute> StreetNetwork::route(const StreetPosition& from, const StreetPosition& to) const {
  const Ways ways = ways_from(from);
  const double by_first = ways.length_px[ends_[to.piece].first] + to.along_px;
  const double by_last = ways.length_px[ends_[to.piece].second] + lengths_px_[to.piece] - to.along_px;
  const double direct = from.piece == to.piece ? std::abs(to.along_px - from.along_px)
                                               : std::numeric_limits<double>::infinity();
  StreetRoute route;
  if (direct <= std::min(by_first, by_last)) {
    if (!std::isfinite(direct)) return std::nullopt;
    add_leg(route, map_->streets[to.piece],
            part_of(map_->streets[to.piece].points, from.along_px, to.along_px));
  } else {
    add_way(ways, from, to, by_first <= by_last, route);
  }
  if (route.line.empty()) route.line = {from.at, to.at};
  set_bearings(route);
  return route;
}

void StreetNetwork::add_way(const Ways& ways, const StreetPosition& from, const StreetPosition& to,
                            bool by_first, StreetRoute& route) const {
  std::size_t node = by_first ? ends_[to.piece].first : ends_[to.piece].second;
  std::vector<std::pair<std::size_t, std::size_t>> steps;  // piece, and the node that it ends at
  for (; ways.by[node] != kNone; node = other_end(steps.back().first, node))
    steps.emplace_back(ways.by[node], node);
  // Of a loop, whose ends are one node, the shorter side.
  const bool forward = ends_[from.piece].second == node &&
                       (ends_[from.piece].first != node || from.along_px > 0.5 * lengths_px_[from.piece]);
  add_leg(route, map_->streets[from.piece],
          part_of(map_->streets[from.piece].points, from.along_px, forward ? lengths_px_[from.piece] : 0.0));
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    const MapStreet& street = map_->streets[step->first];
    add_leg(route, street,
            ends_[step->first].second == step->second ? street.points : reversed(street.points));
  }
  add_leg(route, map_->streets[to.piece],
          part_of(map_->streets[to.piece].points, by_first ? 0.0 : lengths_px_[to.piece], to.along_px));
}

StreetRun StreetNetwork::run_from(std::size_t piece, std::size_t from, std::vector<bool>& used) const {
  StreetRun run;
  run.nodes.push_back(from);
  run.along_px.push_back(0.0);
  std::size_t node = from;
  while (piece != kNone) {
    used[piece] = true;
    const bool forward = ends_[piece].first == node;
    const auto line = forward ? map_->streets[piece].points : reversed(map_->streets[piece].points);
    run.line.insert(run.line.end(), line.begin() + (run.line.empty() ? 0 : 1), line.end());
    run.length_px += lengths_px_[piece];
    node = forward ? ends_[piece].second : ends_[piece].first;
    run.nodes.push_back(node);
    run.along_px.push_back(run.length_px);
    run.pieces.push_back(piece);
    const double bearing = std::remainder(first_bearing(reversed(line)) + std::numbers::pi, kFullTurn);
    const std::string& name = map_->streets[piece].name;
    piece = kNone;
    double least = options_.most_turn_deg / 180.0 * std::numbers::pi;
    for (std::size_t k = 0; k < nodes_[node].pieces.size(); ++k) {
      const std::size_t next = nodes_[node].pieces[k];
      const double turn = turn_between(bearing, nodes_[node].bearings[k]);
      if (used[next] || map_->streets[next].name != name || turn >= least) continue;
      least = turn;
      piece = next;
    }
  }
  return run;
}

std::vector<NamedStreet> StreetNetwork::named_streets(double beside_px) const {
  std::vector<NamedStreet> streets;
  std::vector<bool> used(map_->streets.size(), false);
  const auto street_of = [&](const std::string& name) -> NamedStreet& {
    for (NamedStreet& street : streets)
      if (street.name == name) return street;
    streets.push_back({name, 0.0, false, {}});
    return streets.back();
  };
  // Runs begin at ends of the name; what is left are rings.
  for (const bool rings : {false, true})
    for (std::size_t piece = 0; piece < used.size(); ++piece) {
      const std::string& name = map_->streets[piece].name;
      if (used[piece] || name.empty()) continue;
      for (const std::size_t node : {ends_[piece].first, ends_[piece].second}) {
        const auto& here = nodes_[node].pieces;
        const auto of_name = std::count_if(here.begin(), here.end(),
                                           [&](std::size_t p) { return map_->streets[p].name == name; });
        if (used[piece] || (!rings && of_name != 1)) continue;
        street_of(name).runs.push_back(run_from(piece, node, used));
      }
    }
  for (NamedStreet& street : streets) {
    std::sort(street.runs.begin(), street.runs.end(),
              [](const StreetRun& a, const StreetRun& b) { return a.length_px > b.length_px; });
    std::vector<StreetRun> kept;
    for (StreetRun& run : street.runs) {
      const bool beside = std::any_of(kept.begin(), kept.end(), [&](const StreetRun& other) {
        return is_beside(run.line, other.line, beside_px);
      });
      street.two_carriageways = street.two_carriageways || (beside && run.length_px > 2.0 * beside_px);
      if (beside) continue;
      street.length_px += run.length_px;
      kept.push_back(std::move(run));
    }
    street.runs = std::move(kept);
  }
  std::stable_sort(streets.begin(), streets.end(),
                   [](const NamedStreet& a, const NamedStreet& b) { return a.length_px > b.length_px; });
  return streets;
}

}  // namespace palpable::models
