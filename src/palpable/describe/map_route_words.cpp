// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/map_route_words.hpp"

#include "palpable/core/geometry/map_place.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/map_places.hpp"
#include "palpable/describe/map_text.hpp"
#include "palpable/describe/name_search.hpp"
#include "palpable/describe/numbers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

using models::StreetNode;
using models::StreetPosition;

/// Within this distance on the device a probe is on a street or at a junction.
constexpr double kOnStreet_m = 0.003;
constexpr double kAtJunction_m = 0.0025;

double distance_px(MapPoint a, MapPoint b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// "120 metres to the north-east", "12 millimetres up".
std::string offset_to(const MapGuide& guide, MapPoint from, MapPoint to) {
  return phrase(guide.map().metres_per_px > 0.0 ? "{} to the {}" : "{} {}",
                guide.distance_words(distance_px(from, to)),
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
                           : guide.is_at_edge(end.at) ? tr("the map's edge")
                           : end.pieces.size() == 1   ? tr("a dead end")
                                                      : tr("a junction");
  return fmt::format("{} {}", what, offset_to(guide, on.at, end.at));
}

/// What can be asked for: the streets, the places, then the streets that are not felt.
struct Askable {
  std::vector<std::string> names;
  std::vector<NamedPlace> places;
  std::size_t streets = 0;
};

Askable askable(const MapGuide& guide) {
  Askable all{{}, named_places(guide), guide.streets().size()};
  for (const auto& street : guide.streets()) all.names.push_back(street.name);
  for (const NamedPlace& place : all.places) all.names.push_back(place.name.name);
  all.names.insert(all.names.end(), guide.missing_names().begin(), guide.missing_names().end());
  return all;
}

Error not_found(const std::string& name, const Askable& all) {
  const auto near = similar_names(name, all.names);
  std::vector<std::size_t> longest(std::min(kMostNamesSaid, all.streets));
  std::iota(longest.begin(), longest.end(), std::size_t{0});
  return {ErrorCode::usage,
          phrase("nothing on the map is called '{}'; {} {}", name,
                 near.empty() ? "its longest streets are" : "similar names are",
                 some_of(near.empty() ? longest : near, all.names)),
          {}};
}

/// The one name that is meant, as its number in Askable::names.
Result<std::size_t> one_name(const std::string& name, const Askable& all) {
  const MeantNames found = meant_names(name, all.names);
  if (found.names.empty()) return not_found(name, all);
  if (found.names.size() > 1)
    return Error{ErrorCode::usage, phrase("'{}' could be {}", name, some_of(found.names, all.names)), {}};
  const std::size_t one = found.names.front();
  if (one >= all.streets + all.places.size())
    return Error{ErrorCode::usage,
                 phrase("{} is on the map, but cannot be felt: a smaller part of the map, or a larger "
                        "size, shows it",
                        all.names[one]),
                 {},
                 Reason::map_too_dense};
  return one;
}

/// The junction of two names that a sign at `sign` divides.
Result<StreetPosition> find_junction(const MapGuide& guide, const Askable& all, const std::string& text,
                                     std::size_t sign) {
  const auto first = one_name(text.substr(0, sign), all);
  if (!first) return first.error();
  const auto second = one_name(text.substr(sign + 1), all);
  if (!second) return second.error();
  const std::string &a = all.names[*first], &b = all.names[*second];
  if (a == b)
    return Error{ErrorCode::usage, phrase("a junction is of two streets; '{}' names one", text), {}};
  const auto& nodes = guide.network().nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto here = guide.names_at(i);
    if (std::count(here.begin(), here.end(), a) > 0 && std::count(here.begin(), here.end(), b) > 0)
      return *guide.network().nearest(nodes[i].at, 1.0);
  }
  return Error{ErrorCode::usage, phrase("{} and {} do not meet on the map", a, b), {}};
}

/// Where " to " begins in a text, in any case.
std::vector<std::size_t> dividers(const std::string& text) {
  std::vector<std::size_t> at;
  const auto is_letter = [&text](std::size_t k, char c) {
    return std::tolower(static_cast<unsigned char>(text[k])) == c;
  };
  for (std::size_t k = 0; k + 3 < text.size(); ++k)
    if (text[k] == ' ' && is_letter(k + 1, 't') && is_letter(k + 2, 'o') && text[k + 3] == ' ')
      at.push_back(k);
  return at;
}

}  // namespace

std::string map_position_words(const MapGuide& guide, Place probe) {
  const MapPoint at = guide.pixel_of(probe);
  const auto junction =
      nearest_node(guide, at, [&](std::size_t i) { return guide.network().nodes()[i].pieces.size() > 2; });
  const MapPlace* const place = place_at(guide, at);
  const std::string here = place != nullptr ? phrase("At {}.", place_words(*place)) + " " : std::string();
  if (junction && distance_px(guide.network().nodes()[*junction].at, at) <= guide.pixels_of(kAtJunction_m))
    return here + phrase(guide.network().nodes()[*junction].roundabout ? "At a roundabout: {}."
                                                                       : "At a junction: {}.",
                         bearings_words(guide, *junction));
  const auto on = guide.network().nearest(at, std::numeric_limits<double>::infinity());
  if (!on) return tr("No street.");
  const std::string name = called(guide.map().streets[on->piece]);
  if (on->distance_px > guide.pixels_of(kOnStreet_m))
    return here + phrase("The nearest street is {}, {}.", name, offset_to(guide, at, on->at));
  return here + phrase("On {}, between {} and {}.", name,
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
    std::string name;
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
    if (nearest)
      near.push_back({least, fmt::format("{} {}", street.name, offset_to(guide, at, *nearest)), street.name});
  }
  for (const NamedPlace& named : named_places(guide))
    if (const MapPoint p = guide.pixel_of(named.name.at); true)
      near.push_back(
          {distance_px(p, at), fmt::format("{} {}", named.words, offset_to(guide, at, p)), named.words});
  if (near.empty()) return tr("Nothing with a name is around.");
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
  std::vector<std::string> words;
  // Of several crossings the nearest one is enough.
  std::set<std::string> named;
  for (const Near& one : near)
    if (words.size() < kMostNamed && named.insert(one.name).second) words.push_back(one.words);
  return phrase("Around: {}.", fmt::join(words, "; "));
}

std::vector<std::string> map_parts(const models::Scene& scene, Place probe) {
  const MapGuide guide(scene, MapStreets::felt);
  std::string heading = map_heading(scene, MapGuide(scene));
  std::replace(heading.begin(), heading.end(), '\n', ' ');
  heading.pop_back();
  constexpr std::size_t kMostListed = 6;
  std::string longest = tr("The longest streets.");
  for (std::size_t i = 0; i < std::min(kMostListed, guide.streets().size()); ++i)
    longest += " " + street_words(guide, guide.streets()[i]);
  std::vector<std::string> parts{heading,
                                 map_position_words(guide, probe) + " " + around_words(guide, probe)};
  if (std::string places = special_places_words(guide, kMostListed); !places.empty())
    parts.push_back(std::move(places));
  if (!guide.streets().empty()) parts.push_back(longest);
  return parts;
}

Result<StreetPosition> find_on_map(const MapGuide& guide, const std::string& name) {
  const Askable all = askable(guide);
  // A whole name may hold the sign.
  if (!meant_names(name, all.names).is_whole) {
    std::optional<Error> first_error;
    for (std::size_t sign = name.find('&'); sign != std::string::npos; sign = name.find('&', sign + 1)) {
      auto junction = find_junction(guide, all, name, sign);
      if (junction) return junction;
      if (!first_error) first_error = junction.error();
    }
    if (first_error) return *first_error;
  }
  // As it is said, with its kind.
  for (const NamedPlace& place : all.places)
    if (place.kind && small_letters(place.words) == small_letters(name))
      if (const auto on =
              guide.network().nearest(guide.pixel_of(place.name.at), std::numeric_limits<double>::infinity()))
        return *on;
  const auto found = one_name(name, all);
  if (!found) return found.error();
  const MapPoint at = *found < all.streets
                          ? models::place_along(guide.streets()[*found].runs.front().line,
                                                0.5 * guide.streets()[*found].runs.front().length_px)
                          : guide.pixel_of(all.places[*found - all.streets].name.at);
  const auto on = guide.network().nearest(at, std::numeric_limits<double>::infinity());
  return on ? Result<StreetPosition>(*on) : Result<StreetPosition>(not_found(name, all));
}

Result<RouteEnds> route_ends(const MapGuide& guide, const std::string& text) {
  constexpr std::size_t kDivider = 4;  // " to "
  std::optional<RouteEnds> ends;
  std::optional<Error> first_error;
  const auto names = askable(guide).names;
  for (const std::size_t at : dividers(text)) {
    const std::string a = text.substr(0, at), b = text.substr(at + kDivider);
    const auto from = find_on_map(guide, a);
    const auto to = find_on_map(guide, b);
    if (from && to) {
      const bool whole = meant_names(a, names).is_whole && meant_names(b, names).is_whole;
      if (!ends || whole) ends = RouteEnds{*from, *to};
      if (whole) break;
    } else if (!first_error) {
      first_error = from ? to.error() : from.error();
    }
  }
  constexpr double kSame_px = 1e-6;
  if (ends && distance_px(ends->from.at, ends->to.at) <= kSame_px)
    return Error{ErrorCode::usage, "start and end are the same", {}};
  if (ends) return *ends;
  if (first_error) return *first_error;
  return Error{ErrorCode::usage, "a route is 'A to B': two streets, places, or junctions as 'A & B'", {}};
}

std::string detour_words(const MapGuide& all, const models::StreetRoute& route, const RouteEnds& ends,
                         const DetourOptions& options) {
  const double reach = std::numeric_limits<double>::infinity();
  const auto from = all.network().nearest(ends.from.at, reach), to = all.network().nearest(ends.to.at, reach);
  if (!from || !to) return {};
  const auto shortest = all.network().route(*from, *to);
  if (!shortest) return {};
  const double least_px = all.map().metres_per_px > 0.0 ? options.least_more_m / all.map().metres_per_px
                                                        : all.pixels_of(options.least_more_on_device_m);
  if (route.length_px < options.least_ratio * shortest->length_px ||
      route.length_px < shortest->length_px + least_px)
    return {};
  return phrase("The shortest way, {}, leads over streets that cannot be felt.",
                all.distance_words(shortest->length_px));
}

std::vector<std::string> route_words(const MapGuide& guide, const models::StreetRoute& route) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < route.legs.size(); ++k) {
    const models::RouteLeg& leg = route.legs[k];
    std::string step = called(leg.name, leg.kind);
    if (k > 0) {
      const double turn =
          std::remainder(leg.first_bearing - route.legs[k - 1].last_bearing, 2.0 * std::numbers::pi);
      constexpr double kAhead = std::numbers::pi / 6.0, kSharp = 0.75 * std::numbers::pi;
      const bool is_left = turn < 0.0;
      step = std::abs(turn) < kAhead ? phrase("straight on into {}", step)
             : std::abs(turn) > kSharp
                 ? phrase(is_left ? "turn sharply left into {}" : "turn sharply right into {}", step)
                 : phrase(is_left ? "turn left into {}" : "turn right into {}", step);
    }
    // The next turn is counted from the last direction, which must have been said.
    const std::string first = guide.direction_words(leg.first_bearing);
    const std::string last = guide.direction_words(leg.last_bearing);
    words.push_back(phrase("{}, go {} for {}.", capitalised(step),
                           first == last ? first : phrase("{}, in the end {},", first, last),
                           guide.distance_words(leg.length_px)));
  }
  words.emplace_back(tr("There is the end."));
  return words;
}

}  // namespace palpable::describe
