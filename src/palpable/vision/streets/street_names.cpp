// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/street_names.hpp"

#include "palpable/core/geometry/map_place.hpp"
#include "palpable/core/geometry/segment.hpp"
#include "palpable/vision/streets/gazetteer.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace palpable::vision {
namespace {

struct Vector2 {
  double x = 0.0;
  double y = 0.0;
};

Vector2 between(MapPoint a, MapPoint b) { return {b.x - a.x, b.y - a.y}; }

/// The cosine of the angle between two directions.
double cosine(Vector2 a, Vector2 b) {
  const double n = std::hypot(a.x, a.y) * std::hypot(b.x, b.y);
  return n > 0.0 ? (a.x * b.x + a.y * b.y) / n : 0.0;
}

/// The distance from a point to the nearest part of a street that runs along `along`, pixels.
double distance_along(const MapStreet& street, MapPoint p, Vector2 along, double least_cosine) {
  double least = 1e9;
  for (std::size_t i = 1; i < street.points.size(); ++i) {
    const MapPoint a = street.points[i - 1];
    const Vector2 d = between(a, street.points[i]);
    if (std::abs(cosine(d, along)) < least_cosine) continue;
    least = std::min(least, distance_to_segment(p, a, street.points[i]));
  }
  return least;
}

/// How many points of a name lie on each street.
struct Votes {
  std::map<std::size_t, int> of_street;
  double part = 0.0;
};

Votes votes_of(const StreetMap& map, const TextLine& line, const StreetNameOptions& options) {
  const auto step = static_cast<std::size_t>(options.step_points);
  const double least_cosine = std::cos(options.aside_deg * std::numbers::pi / 180.0);
  Votes votes;
  int all = 0;
  int on_street = 0;
  const auto& p = line.centre;
  const auto reach = static_cast<std::size_t>(line.height_px);
  for (std::size_t i = 0; i < p.size(); i += step) {
    const Vector2 along = between(p[i - std::min(i, reach)], p[std::min(p.size() - 1, i + reach)]);
    std::optional<std::size_t> best;
    double least = options.aside * line.height_px;
    for (std::size_t s = 0; s < map.streets.size(); ++s)
      if (const double d = distance_along(map.streets[s], p[i], along, least_cosine); d < least) {
        least = d;
        best = s;
      }
    ++all;
    if (!best) continue;
    ++on_street;
    ++votes.of_street[*best];
  }
  votes.part = static_cast<double>(on_street) / all;
  return votes;
}

/// The direction out of a street at one of its ends.
Vector2 direction_out(const MapStreet& street, bool last, const StreetNameOptions& options) {
  const auto& p = street.points;
  const MapPoint end = last ? p.back() : p.front();
  const double reach = std::max(options.least_end_px, options.end_widths * street.width_px);
  for (std::size_t k = 1; k < p.size(); ++k) {
    const MapPoint inner = last ? p[p.size() - 1 - k] : p[k];
    if (std::hypot(end.x - inner.x, end.y - inner.y) >= reach || k + 1 == p.size())
      return between(inner, end);
  }
  return {};
}

bool same_place(MapPoint a, MapPoint b) { return std::hypot(a.x - b.x, a.y - b.y) < 1.0; }

/// The street that continues `street` straight over the junction at that end, if its name is not known.
std::optional<std::size_t> continuation(const StreetMap& map, std::size_t street, bool last,
                                        const StreetNameOptions& options) {
  const MapStreet& from = map.streets[street];
  const MapPoint end = last ? from.points.back() : from.points.front();
  const Vector2 out = direction_out(from, last, options);
  std::optional<std::size_t> best;
  double straightest = std::cos(options.most_turn_deg * std::numbers::pi / 180.0);
  for (std::size_t k = 0; k < map.streets.size(); ++k)
    for (const bool other_last : {false, true}) {
      const MapStreet& to = map.streets[k];
      if (k == street || !same_place(other_last ? to.points.back() : to.points.front(), end)) continue;
      const Vector2 in = direction_out(to, other_last, options);
      const double straight = cosine(out, {-in.x, -in.y});
      if (straight <= straightest) continue;
      straightest = straight;
      best = k;
    }
  if (!best || !map.streets[*best].name.empty()) return std::nullopt;
  const double width = map.streets[*best].width_px;
  const bool alike =
      std::abs(width - from.width_px) <= options.most_width_change * std::max(width, from.width_px);
  return alike ? best : std::nullopt;
}

/// Names go on over junctions, until nothing changes.
void continue_names(StreetMap& map, const StreetNameOptions& options) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t s = 0; s < map.streets.size(); ++s) {
      if (map.streets[s].name.empty()) continue;
      for (const bool last : {false, true})
        if (const auto next = continuation(map, s, last, options)) {
          map.streets[*next].name = map.streets[s].name;
          changed = true;
        }
    }
  }
}

MapLabel label_of(const TextLine& line, const ReadLine& read, bool names_street) {
  std::vector<MapPoint> p = line.centre;
  if (read.reversed) std::reverse(p.begin(), p.end());
  const Vector2 along = between(p.front(), p.back());
  const double n = std::max(1e-9, std::hypot(along.x, along.y));
  const double half = 0.5 * line.height_px;
  const Vector2 up{along.y / n * half, -along.x / n * half};
  const auto moved = [](MapPoint q, Vector2 by, double sign) {
    return MapPoint{q.x + sign * by.x, q.y + sign * by.y};
  };
  return {read.text,
          read.confidence,
          std::atan2(along.y, along.x) * 180.0 / std::numbers::pi,
          {moved(p.front(), up, 1.0), moved(p.back(), up, 1.0), moved(p.back(), up, -1.0),
           moved(p.front(), up, -1.0)},
          names_street};
}

/// Whether a line of lettering ends at the picture's border, which may cut it off.
bool is_at_border(const StreetMap& map, const TextLine& line, const StreetNameOptions& options) {
  const double most = options.border_heights * line.height_px;
  const auto is_near = [&](MapPoint p) {
    return std::min({p.x, p.y, map.width_px - 1 - p.x, map.height_px - 1 - p.y}) <= most;
  };
  return is_near(line.centre.front()) || is_near(line.centre.back());
}

/// Whether a name begins with the word of streets, in small letters: "quai de l'hirondelle".
bool is_small_name(std::string_view words) {
  std::string large(words);
  if (!large.empty())
    large.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(large.front())));
  return is_whole_name(large) && is_street_name(words.substr(0, words.find(' ')));
}

/// What is read as a street's name, spelled as in the gazetteer; nullopt if that has no such name.
std::optional<std::string> name_of(const StreetMap& map, const TextLine& line, const ReadLine& read,
                                   const StreetNameOptions& options) {
  if (options.gazetteer.empty()) {
    const bool is_name = read.confidence >= options.least_confidence &&
                         (is_whole_name(read.text) || is_small_name(read.text)) &&
                         !is_at_border(map, line, options);
    return is_name ? std::optional(read.text) : std::nullopt;
  }
  return nearest_name(read.text, options.gazetteer, options.least_similarity);
}

}  // namespace

bool is_whole_name(std::string_view words) {
  if (words.empty()) return false;
  const auto first = static_cast<unsigned char>(words.front());
  if (std::islower(first) != 0) return false;
  static constexpr std::string_view kMarks = " '-./,()&";
  return std::all_of(words.begin(), words.end(), [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return u >= 0x80 || std::isalnum(u) != 0 || kMarks.find(c) != std::string_view::npos;
  });
}

void add_names(StreetMap& map, std::span<const TextLine> lines, std::span<const ReadLine> read,
               const StreetNameOptions& options) {
  // The surest name of each street wins.
  std::vector<double> confidence(map.streets.size(), 0.0);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (read[i].text.empty()) continue;
    const Votes votes = votes_of(map, lines[i], options);
    const std::optional<std::string> name =
        votes.part >= options.least_part_on_street ? name_of(map, lines[i], read[i], options) : std::nullopt;
    map.labels.push_back(label_of(lines[i], read[i], name.has_value()));
    if (!name) continue;
    map.labels.back().text = *name;
    int most = 0;
    for (const auto& [street, count] : votes.of_street) most = std::max(most, count);
    for (const auto& [street, count] : votes.of_street) {
      if (count < options.crossing_part * most || read[i].confidence <= confidence[street]) continue;
      confidence[street] = read[i].confidence;
      map.streets[street].name = *name;
    }
  }
  continue_names(map, options);
}

}  // namespace palpable::vision
