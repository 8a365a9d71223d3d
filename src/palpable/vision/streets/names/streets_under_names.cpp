// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/streets_under_names.hpp"

#include "palpable/core/geometry/map_place.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpable::vision {
namespace {

double distance_between(MapPoint a, MapPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Part of a name's points that are near to a centre line.
double part_on(const CentreLines& graph, const TextLine& name, double reach_px) {
  constexpr std::size_t kStep = 3;
  int all = 0;
  int near = 0;
  for (std::size_t i = 0; i < name.centre.size(); i += kStep) {
    const MapPoint p = name.centre[i];
    const bool is_near = std::any_of(graph.lines.begin(), graph.lines.end(), [&](const CentreLine& line) {
      return std::any_of(line.points.begin(), line.points.end(), [&](MapPoint q) {
        return std::abs(p.x - q.x) <= reach_px && distance_between(p, q) <= reach_px;
      });
    });
    ++all;
    near += is_near ? 1 : 0;
  }
  return static_cast<double>(near) / std::max(1, all);
}

bool is_on_street(const CentreLines& graph, const TextLine& name, const StreetsUnderNamesOptions& options) {
  return part_on(graph, name, options.aside * name.height_px) >= options.least_part_on_street;
}

template <class T>
T median_of(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A node on the street that a name's end points to; one at the end itself if there is none.
int node_before(CentreLines& graph, const TextLine& name, bool last,
                const StreetsUnderNamesOptions& options) {
  const auto& p = name.centre;
  const MapPoint end = last ? p.back() : p.front();
  const std::size_t back = std::min(p.size() - 1, static_cast<std::size_t>(2.0 * name.height_px));
  const MapPoint inner = last ? p[p.size() - 1 - back] : p[back];
  const double length = std::max(1e-9, distance_between(end, inner));
  const MapPoint along{(end.x - inner.x) / length, (end.y - inner.y) / length};
  const double least = std::cos(options.reach_angle_deg * std::numbers::pi / 180.0);
  double nearest = options.reach_heights * name.height_px;
  std::optional<std::pair<std::size_t, std::size_t>> best;
  for (std::size_t i = 0; i < graph.lines.size(); ++i)
    for (std::size_t k = 0; k < graph.lines[i].points.size(); ++k) {
      const MapPoint q = graph.lines[i].points[k];
      const double d = distance_between(end, q);
      const bool is_ahead = (q.x - end.x) * along.x + (q.y - end.y) * along.y >= least * d;
      if (d >= nearest || !is_ahead) continue;
      nearest = d;
      best = {i, k};
    }
  if (best) return split_line(graph, best->first, best->second);
  graph.nodes.push_back(end);
  return static_cast<int>(graph.nodes.size()) - 1;
}

void add_street(CentreLines& graph, const TextLine& name, double radius_px,
                const StreetsUnderNamesOptions& options) {
  const int first = node_before(graph, name, false, options);
  const int last = node_before(graph, name, true, options);
  if (first == last) return;
  CentreLine line{name.centre, first, last, radius_px, 0.0};
  line.points.insert(line.points.begin(), graph.nodes[static_cast<std::size_t>(first)]);
  line.points.push_back(graph.nodes[static_cast<std::size_t>(last)]);
  graph.lines.push_back(std::move(line));
}

bool is_alike(const TextLine& line, const StreetLettering& names, double most_colour_difference,
              double most_height_ratio) {
  const double ratio = line.height_px / names.height_px;
  const double r = line.colour.r - names.colour.r;
  const double g = line.colour.g - names.colour.g;
  const double b = line.colour.b - names.colour.b;
  return std::sqrt(r * r + g * g + b * b) <= most_colour_difference &&
         std::max(ratio, 1.0 / ratio) <= most_height_ratio;
}

}  // namespace

std::vector<Parameter> parameters_of(StreetsUnderNamesOptions& o) {
  return {
      {"least_part_on_street", &o.least_part_on_street, {0, 1}, "", "part of a name on its street"},
      {"aside", &o.aside, {0, 5}, "heights", "how far it is beside the street's middle"},
      {"least_confidence", &o.least_confidence, {0, 1}, "", "of names that show a street"},
      {"least_name_confidence", &o.least_name_confidence, {0, 1}, "", "of a name on a street that it hides"},
      {"fewest_names", &o.fewest_names, {1, 100}, "", "names that show how streets are lettered"},
      {"most_colour_difference", &o.most_colour_difference, {0, 442}, "levels", "from these names"},
      {"most_height_ratio", &o.most_height_ratio, {1, 10}, "", "height of these names"},
      {"most_name_colour_difference",
       &o.most_name_colour_difference,
       {0, 442},
       "levels",
       "from these names, of words of streets"},
      {"reach_heights", &o.reach_heights, {0, 20}, "heights", "how far the next street is"},
      {"reach_angle_deg", &o.reach_angle_deg, {0, 90}, "degrees", "its direction"}};
}

std::optional<StreetLettering> street_lettering(const CentreLines& graph, std::span<const TextLine> lines,
                                                std::span<const ReadLine> read,
                                                const StreetsUnderNamesOptions& options) {
  std::vector<double> heights;
  std::vector<std::uint8_t> red, green, blue;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (read[i].confidence < options.least_confidence || !is_on_street(graph, lines[i], options)) continue;
    heights.push_back(lines[i].height_px);
    red.push_back(lines[i].colour.r);
    green.push_back(lines[i].colour.g);
    blue.push_back(lines[i].colour.b);
  }
  if (heights.size() < static_cast<std::size_t>(options.fewest_names)) return std::nullopt;
  return StreetLettering{median_of(heights), {median_of(red), median_of(green), median_of(blue)}};
}

bool is_lettered_like(const TextLine& line, const StreetLettering& names,
                      const StreetsUnderNamesOptions& options) {
  return is_alike(line, names, options.most_colour_difference, options.most_height_ratio);
}

int add_streets_under(CentreLines& graph, std::span<const TextLine> lines, std::span<const ReadLine> read,
                      const StreetsUnderNamesOptions& options) {
  const auto names = street_lettering(graph, lines, read, options);
  if (!names || graph.lines.empty()) return 0;
  std::vector<double> radii;
  for (const CentreLine& line : graph.lines) radii.push_back(line.radius_px);
  const double radius = median_of(radii);
  int added = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (read[i].confidence < options.least_name_confidence || !is_street_name(read[i].text) ||
        !is_alike(lines[i], *names, options.most_name_colour_difference, options.most_height_ratio) ||
        is_on_street(graph, lines[i], options))
      continue;
    add_street(graph, lines[i], std::min(radius, 0.5 * lines[i].height_px), options);
    ++added;
  }
  return added;
}

}  // namespace palpable::vision
