// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/street_names.hpp"

#include "palpable/core/geometry/map_place.hpp"
#include "palpable/core/geometry/segment.hpp"
#include "palpable/vision/streets/names/gazetteer.hpp"
#include "palpable/vision/streets/names/name_pieces.hpp"

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

/// How many points of a name lie on each street, and which.
struct Votes {
  std::map<std::size_t, int> of_street;
  std::map<std::size_t, std::vector<MapPoint>> points;
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
    votes.points[*best].push_back(p[i]);
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

/// Whether a line of lettering ends at the picture's border, which may have cut off letters of it.
bool may_be_cut_off(const StreetMap& map, const TextLine& line, const ReadLine& read,
                    const StreetNameOptions& options) {
  const double most = options.border_heights * line.height_px;
  const auto is_near = [&](MapPoint p) {
    return std::min({p.x, p.y, map.width_px - 1 - p.x, map.height_px - 1 - p.y}) <= most;
  };
  const bool first = is_near(read.reversed ? line.centre.back() : line.centre.front());
  const bool last = is_near(read.reversed ? line.centre.front() : line.centre.back());
  const std::string_view words = read.text;
  return (first && !(is_whole_name(words) && is_street_name(words))) ||
         (last && !is_street_name(words.substr(words.rfind(' ') + 1)));
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
  if (read.text.empty()) return std::nullopt;
  if (options.gazetteer.empty()) {
    const bool is_name = read.confidence >= options.least_confidence && !is_piece_of_name(read.text) &&
                         (is_whole_name(read.text) || is_small_name(read.text)) &&
                         !may_be_cut_off(map, line, read, options);
    return is_name ? std::optional(read.text) : std::nullopt;
  }
  return nearest_name(read.text, options.gazetteer, options.least_similarity);
}

/// For each line of lettering, the name of a street that it can be, if it lies on one.
using Names = std::vector<std::optional<std::string>>;
Names names_of(const StreetMap& map, std::span<const TextLine> lines, std::span<const ReadLine> read,
               const StreetNameOptions& options, const std::optional<StreetLettering>& lettering) {
  const auto is_other = [&](std::size_t i) {
    return options.gazetteer.empty() && lettering && !is_street_name(read[i].text) &&
           !is_lettered_like(lines[i], *lettering);
  };
  std::vector<char> stacked(lines.size(), 0);
  if (options.gazetteer.empty()) stacked = stacked_lettering(lines, read, options.stacked);
  Names names(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (stacked[i] == 0 && !is_other(i)) names[i] = name_of(map, lines[i], read[i], options);
  return names;
}

/// A name on a street: where along it, in points of the street's line with steps of a pixel.
struct NameAt {
  double along_px = 0.0;
  std::string form;
};

/// Length of a street up to its place that is nearest to a point.
double along_street(const MapStreet& street, MapPoint p) {
  double length = 0.0, nearest = 1e18, at = 0.0;
  for (std::size_t i = 1; i < street.points.size(); ++i) {
    const MapPoint a = street.points[i - 1];
    const Vector2 d = between(a, street.points[i]);
    const double n = std::hypot(d.x, d.y);
    const double t = n > 0.0 ? std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / (n * n), 0.0, 1.0) : 0.0;
    const double distance = std::hypot(a.x + t * d.x - p.x, a.y + t * d.y - p.y);
    if (distance < nearest) {
      nearest = distance;
      at = length + t * n;
    }
    length += n;
  }
  return at;
}

/// Divides a street at a length of it; the rest becomes a street of its own.
void divide(StreetMap& map, std::size_t number, double along_px) {
  MapStreet rest = map.streets[number];
  MapStreet& street = map.streets[number];
  double length = 0.0;
  for (std::size_t i = 1; i < rest.points.size(); ++i) {
    const MapPoint a = rest.points[i - 1];
    const Vector2 d = between(a, rest.points[i]);
    const double n = std::hypot(d.x, d.y);
    if (length + n < along_px) {
      length += n;
      continue;
    }
    const double t = n > 0.0 ? (along_px - length) / n : 0.0;
    const MapPoint cut{a.x + t * d.x, a.y + t * d.y};
    street.points.resize(i);
    street.points.push_back(cut);
    rest.points.erase(rest.points.begin(), rest.points.begin() + static_cast<std::ptrdiff_t>(i));
    rest.points.insert(rest.points.begin(), cut);
    map.streets.push_back(std::move(rest));
    return;
  }
}

/// Divides streets that carry different names one after the other, midway between these: where a street
/// bends into another one there is no junction.
void divide_between_names(StreetMap& map, std::span<const TextLine> lines, const Names& names,
                          const StreetNameOptions& options) {
  std::map<std::size_t, std::vector<NameAt>> on_street;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!names[i]) continue;
    const Votes votes = votes_of(map, lines[i], options);
    if (votes.part < options.least_part_on_street) continue;
    int most = 0;
    for (const auto& [street, count] : votes.of_street) most = std::max(most, count);
    for (const auto& [street, points] : votes.points)
      if (votes.of_street.at(street) >= options.divided_part * most)
        on_street[street].push_back(
            {along_street(map.streets[street], points[points.size() / 2]), compared_form(*names[i])});
  }
  for (auto& [street, here] : on_street) {
    std::sort(here.begin(), here.end(),
              [](const NameAt& a, const NameAt& b) { return a.along_px > b.along_px; });
    // From the end, so that the lengths before the cuts stay.
    for (std::size_t k = 1; k < here.size(); ++k)
      if (similarity_of(here[k - 1].form, here[k].form) < options.same_name)
        divide(map, street, 0.5 * (here[k - 1].along_px + here[k].along_px));
  }
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

void spell_by_gazetteer(std::span<ReadLine> read, std::span<const std::string> gazetteer, double least) {
  if (gazetteer.empty()) return;
  for (ReadLine& line : read) {
    std::map<std::string, double> votes;
    double best = 0.0;
    for (const std::string& text : line.others)
      if (const auto name = nearest_name(text, gazetteer, least)) {
        const double similarity = similarity_of(compared_form(text), compared_form(*name));
        double& sum = votes[*name];
        sum += similarity * similarity;
        if (sum <= best) continue;
        best = sum;
        line.text = *name;
        line.confidence = std::max(line.confidence, similarity);
        line.weight = std::max(line.weight, best);
      }
  }
}

void add_names(StreetMap& map, std::span<const TextLine> lines, std::span<const ReadLine> read,
               const StreetNameOptions& options, const std::optional<StreetLettering>& lettering) {
  const Names names = names_of(map, lines, read, options, lettering);
  divide_between_names(map, lines, names, options);
  // The surest name of each street wins.
  std::vector<double> confidence(map.streets.size(), 0.0);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (read[i].text.empty()) continue;
    const Votes votes = votes_of(map, lines[i], options);
    const std::optional<std::string> name =
        votes.part >= options.least_part_on_street ? names[i] : std::nullopt;
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
