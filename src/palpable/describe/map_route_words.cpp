// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/map_route_words.hpp"

#include "palpable/core/edit_distance.hpp"
#include "palpable/describe/map_text.hpp"
#include "palpable/describe/numbers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

using models::StreetNode;
using models::StreetPosition;

/// Within this distance on the device a probe is on a street or at a junction.
constexpr double kOnStreet_m = 0.003;
constexpr double kAtJunction_m = 0.0025;

double distance_px(MapPoint a, MapPoint b) { return std::hypot(b.x - a.x, b.y - a.y); }

std::string name_or_unnamed(const std::string& name) { return name.empty() ? kUnnamedStreet : name; }

/// "120 metres to the north-east", "12 millimetres up".
std::string offset_to(const MapGuide& guide, MapPoint from, MapPoint to) {
  return fmt::format("{}{}{}", guide.distance_words(distance_px(from, to)),
                     guide.map().metres_per_px > 0.0 ? " to the " : " ",
                     guide.direction_words(models::bearing_of(from, to)));
}

/// The node nearest to a place among those that a filter accepts.
template <class Accepts>
std::optional<std::size_t> nearest_node(const MapGuide& guide, MapPoint at, const Accepts& accepts) {
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  const auto& nodes = guide.network().nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const double d = distance_px(nodes[i].at, at); d < least && accepts(i)) {
      least = d;
      best = i;
    }
  return best;
}

/// The other streets at a node, without one name; empty if there are none.
std::string others_at(const MapGuide& guide, std::size_t node, const std::string& own) {
  auto names = guide.names_at(node);
  std::erase(names, own);
  return listed(names);
}

/// What lies at an end of a piece, seen from a place on it.
std::string end_of_piece(const MapGuide& guide, std::size_t node, const StreetPosition& on) {
  const std::string others = others_at(guide, node, guide.map().streets[on.piece].name);
  const StreetNode& end = guide.network().nodes()[node];
  const std::string what = !others.empty()            ? others
                           : guide.is_at_edge(end.at) ? "the map's edge"
                           : end.pieces.size() == 1   ? "a dead end"
                                                      : "a junction";
  return fmt::format("{} {}", what, offset_to(guide, on.at, end.at));
}

/// A place that a label names.
struct LabelPlace {
  std::string name;
  MapPoint at;
};

std::vector<LabelPlace> label_places(const StreetMap& map) {
  std::vector<LabelPlace> places;
  for (const MapLabel& label : map.labels)
    if (!label.names_street && !label.box.empty()) {
      const MapPoint a = label.box.front(), b = label.box[label.box.size() / 2];
      places.push_back({label.text, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}});
    }
  return places;
}

std::string small_letters(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.substr(std::min(text.find_first_not_of(' '), text.size()));
}

/// The number of the name that is meant: the same, the only one that begins so, or the one spelled most like
/// it.
std::optional<std::size_t> meant(const std::string& asked, const std::vector<std::string>& names) {
  const std::string wanted = small_letters(asked);
  if (wanted.empty()) return std::nullopt;
  std::vector<std::size_t> begin_so;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = small_letters(names[i]);
    if (name == wanted) return i;
    if (name.starts_with(wanted)) begin_so.push_back(i);
  }
  if (begin_so.size() == 1) return begin_so.front();
  // One letter in five may differ.
  std::optional<std::size_t> best;
  std::size_t least = wanted.size() / 5 + 1;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const std::size_t d = edit_distance(wanted, small_letters(names[i])); d < least) {
      least = d;
      best = i;
    }
  return best;
}

std::vector<std::string> street_names(const MapGuide& guide) {
  std::vector<std::string> names;
  for (const auto& street : guide.streets()) names.push_back(street.name);
  return names;
}

Error not_found(const MapGuide& guide, const std::string& name) {
  auto names = street_names(guide);
  constexpr std::size_t kMostNamed = 8;
  if (names.size() > kMostNamed) names.resize(kMostNamed);
  return {ErrorCode::usage,
          fmt::format("nothing on the map is called '{}'; its longest streets are {}", name, listed(names)),
          {}};
}

Result<StreetPosition> find_junction(const MapGuide& guide, const std::string& text, std::size_t sign) {
  const auto names = street_names(guide);
  const auto first = meant(text.substr(0, sign), names), second = meant(text.substr(sign + 1), names);
  if (!first || !second) return not_found(guide, text.substr(0, first ? std::string::npos : sign));
  const auto& nodes = guide.network().nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto here = guide.names_at(i);
    if (std::count(here.begin(), here.end(), names[*first]) > 0 &&
        std::count(here.begin(), here.end(), names[*second]) > 0)
      return *guide.network().nearest(nodes[i].at, 1.0);
  }
  return Error{
      ErrorCode::usage, fmt::format("{} and {} do not meet on the map", names[*first], names[*second]), {}};
}

}  // namespace

std::string map_position_words(const MapGuide& guide, Place place) {
  const MapPoint at = guide.pixel_of(place);
  const auto junction =
      nearest_node(guide, at, [&](std::size_t i) { return guide.network().nodes()[i].pieces.size() > 2; });
  if (junction && distance_px(guide.network().nodes()[*junction].at, at) <= guide.pixels_of(kAtJunction_m))
    return fmt::format("At a junction: {}.", bearings_words(guide, *junction));
  const auto on = guide.network().nearest(at, std::numeric_limits<double>::infinity());
  if (!on) return "No street.";
  const std::string name = name_or_unnamed(guide.map().streets[on->piece].name);
  if (on->distance_px > guide.pixels_of(kOnStreet_m))
    return fmt::format("The nearest street is {}, {}.", name, offset_to(guide, at, on->at));
  return fmt::format("On {}, between {} and {}.", name,
                     end_of_piece(guide, guide.network().first_node(on->piece), *on),
                     end_of_piece(guide, guide.network().last_node(on->piece), *on));
}

std::string around_words(const MapGuide& guide, Place place) {
  constexpr std::size_t kMostNamed = 4;
  const MapPoint at = guide.pixel_of(place);
  const auto here = guide.network().nearest(at, guide.pixels_of(kOnStreet_m));
  const std::string own = here ? guide.map().streets[here->piece].name : std::string();
  struct Near {
    double distance;
    std::string words;
  };
  std::vector<Near> near;
  for (const auto& street : guide.streets()) {
    if (street.name == own) continue;
    std::optional<MapPoint> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& run : street.runs) {
      const MapPoint p = models::nearest_on(run.line, at);
      if (const double d = distance_px(p, at); d < least) least = d, nearest = p;
    }
    if (nearest) near.push_back({least, fmt::format("{} {}", street.name, offset_to(guide, at, *nearest))});
  }
  for (const LabelPlace& label : label_places(guide.map()))
    near.push_back(
        {distance_px(label.at, at), fmt::format("{} {}", label.name, offset_to(guide, at, label.at))});
  if (near.empty()) return "Nothing with a name is around.";
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
  std::vector<std::string> words;
  for (std::size_t k = 0; k < std::min(kMostNamed, near.size()); ++k) words.push_back(near[k].words);
  return fmt::format("Around: {}.", fmt::join(words, "; "));
}

std::vector<std::string> map_parts(const models::Scene& scene, Place probe) {
  const MapGuide guide(scene, MapStreets::felt);
  std::string heading = map_heading(scene, MapGuide(scene));
  std::replace(heading.begin(), heading.end(), '\n', ' ');
  heading.pop_back();
  std::string longest = "The longest streets.";
  constexpr std::size_t kMostListed = 6;
  for (std::size_t i = 0; i < std::min(kMostListed, guide.streets().size()); ++i)
    longest += " " + street_words(guide, guide.streets()[i]);
  std::vector<std::string> parts{heading,
                                 map_position_words(guide, probe) + " " + around_words(guide, probe)};
  if (!guide.streets().empty()) parts.push_back(longest);
  return parts;
}

Result<StreetPosition> find_on_map(const MapGuide& guide, const std::string& name) {
  if (const std::size_t sign = name.find('&'); sign != std::string::npos)
    return find_junction(guide, name, sign);
  const auto places = label_places(guide.map());
  std::vector<std::string> names = street_names(guide);
  const std::size_t streets = names.size();
  for (const LabelPlace& place : places) names.push_back(place.name);
  const auto found = meant(name, names);
  if (!found) return not_found(guide, name);
  const MapPoint at = *found < streets
                          ? models::place_along(guide.streets()[*found].runs.front().line,
                                                0.5 * guide.streets()[*found].runs.front().length_px)
                          : places[*found - streets].at;
  const auto on = guide.network().nearest(at, std::numeric_limits<double>::infinity());
  return on ? Result<StreetPosition>(*on) : Result<StreetPosition>(not_found(guide, name));
}

Result<RouteEnds> route_ends(const MapGuide& guide, const std::string& text) {
  constexpr std::string_view kTo = " to ";
  const std::size_t at = text.find(kTo);
  if (at == std::string::npos)
    return Error{ErrorCode::usage, "a route is 'A to B': two streets, places, or junctions as 'A & B'", {}};
  const auto from = find_on_map(guide, text.substr(0, at));
  if (!from) return from.error();
  const auto to = find_on_map(guide, text.substr(at + kTo.size()));
  if (!to) return to.error();
  return RouteEnds{*from, *to};
}

std::vector<std::string> route_words(const MapGuide& guide, const models::StreetRoute& route) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < route.legs.size(); ++k) {
    const models::RouteLeg& leg = route.legs[k];
    std::string step = name_or_unnamed(leg.name);
    if (k > 0) {
      const double turn =
          std::remainder(leg.first_bearing - route.legs[k - 1].last_bearing, 2.0 * std::numbers::pi);
      constexpr double kAhead = std::numbers::pi / 6.0, kSharp = 0.75 * std::numbers::pi;
      const char* const side = turn < 0.0 ? "left" : "right";
      step = std::abs(turn) < kAhead   ? fmt::format("straight on into {}", step)
             : std::abs(turn) > kSharp ? fmt::format("turn sharply {} into {}", side, step)
                                       : fmt::format("turn {} into {}", side, step);
    }
    words.push_back(fmt::format("{}, go {} for {}.", capitalised(step),
                                guide.direction_words(leg.first_bearing),
                                guide.distance_words(leg.length_px)));
  }
  words.emplace_back("There is the end.");
  return words;
}

}  // namespace palpable::describe
