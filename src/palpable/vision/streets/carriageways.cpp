// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/carriageways.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::vision {
namespace {

/// The median radius of lines, weighted by their length; 0 if there are none.
double common_radius(const CentreLines& graph) {
  std::vector<std::pair<double, double>> radii;
  double all = 0.0;
  for (const CentreLine& line : graph.lines) {
    radii.emplace_back(line.radius_px, length_px(line.points));
    all += radii.back().second;
  }
  std::sort(radii.begin(), radii.end());
  double sum = 0.0;
  for (const auto& [radius, length] : radii)
    if ((sum += length) * 2.0 >= all) return radius;
  return 0.0;
}

/// The direction of a line out of one of its nodes, over about its own width; length 1.
MapPoint direction_from(const CentreLine& line, bool last, double reach_px) {
  const auto& p = line.points;
  const auto reach = std::min(p.size() - 1, static_cast<std::size_t>(std::max(4.0, 2.0 * reach_px)));
  const MapPoint from = last ? p.back() : p.front();
  const MapPoint to = last ? p[p.size() - 1 - reach] : p[reach];
  const double n = std::max(1e-9, std::hypot(to.x - from.x, to.y - from.y));
  return {(to.x - from.x) / n, (to.y - from.y) / n};
}

/// The radius of a carriageway where a line divides into two that go on in its direction; 0 if it does not.
double fork_radius(const CentreLines& graph, std::size_t number, const CarriagewayOptions& options) {
  const CentreLine& line = graph.lines[number];
  constexpr double kAhead = 0.7;
  for (const bool last : {false, true}) {
    const int node = last ? line.last : line.first;
    const MapPoint back = direction_from(line, last, line.radius_px);
    double widest = 0.0;
    int ahead = 0;
    for (std::size_t k = 0; k < graph.lines.size(); ++k) {
      const CentreLine& other = graph.lines[k];
      if (k == number || (other.first != node && other.last != node)) continue;
      const MapPoint out = direction_from(other, other.last == node, line.radius_px);
      if (-(out.x * back.x + out.y * back.y) < kAhead) continue;
      ++ahead;
      widest = std::max(widest, other.radius_px);
    }
    if (ahead == 2 && line.radius_px >= options.fork_ratio * widest) return widest;
  }
  return 0.0;
}

/// The line moved sideways by `offset_px`; at junctions it keeps its end.
std::vector<MapPoint> moved_aside(const CentreLine& line, double offset_px, bool first_fixed,
                                  bool last_fixed) {
  const std::vector<MapPoint> p = smoothed(line.points, static_cast<int>(line.radius_px));
  const auto n = p.size();
  const auto reach = std::max<std::size_t>(2, static_cast<std::size_t>(line.radius_px));
  std::vector<MapPoint> out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const MapPoint a = p[i - std::min(i, reach)];
    const MapPoint b = p[std::min(n - 1, i + reach)];
    const double length = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
    const double from_first = first_fixed ? static_cast<double>(i) : 1e9;
    const double from_last = last_fixed ? static_cast<double>(n - 1 - i) : 1e9;
    const double part = std::min(1.0, std::min(from_first, from_last) / std::max(1.0, std::abs(offset_px)));
    out[i] = {p[i].x - part * offset_px * (b.y - a.y) / length,
              p[i].y + part * offset_px * (b.x - a.x) / length};
  }
  return out;
}

void divide(CentreLines& graph, std::size_t number, double radius_px, const std::vector<int>& degrees) {
  const CentreLine line = graph.lines[number];
  const double offset = line.radius_px - radius_px;
  const auto at_junction = [&degrees](int node) { return degrees[static_cast<std::size_t>(node)] > 1; };
  for (const double side : {offset, -offset}) {
    CentreLine way = line;
    way.points = moved_aside(line, side, at_junction(line.first), at_junction(line.last));
    way.radius_px = radius_px;
    way.radius_spread_px = std::min(line.radius_spread_px, 0.2 * radius_px);
    for (int* node : {&way.first, &way.last}) {
      if (at_junction(*node)) continue;
      const bool is_first = node == &way.first;
      *node = static_cast<int>(graph.nodes.size());
      graph.nodes.push_back(is_first ? way.points.front() : way.points.back());
    }
    if (side > 0.0)
      graph.lines[number] = std::move(way);
    else
      graph.lines.push_back(std::move(way));
  }
}

}  // namespace

void divide_carriageways(std::vector<CentreLines*> colours, const CarriagewayOptions& options) {
  double all = 0.0;
  std::vector<double> lengths;
  std::vector<double> radii;
  for (const CentreLines* graph : colours) {
    double length = 0.0;
    for (const CentreLine& line : graph->lines) length += length_px(line.points);
    lengths.push_back(length);
    radii.push_back(common_radius(*graph));
    all += length;
  }
  for (std::size_t c = 0; c < colours.size(); ++c) {
    double widest_other = 0.0;
    for (std::size_t k = 0; k < colours.size(); ++k)
      if (k != c && lengths[k] >= options.common_part * all) widest_other = std::max(widest_other, radii[k]);
    CentreLines& graph = *colours[c];
    const std::vector<int> degrees = degrees_of(graph);
    // Decided before any line is divided.
    std::vector<double> radius(graph.lines.size(), 0.0);
    for (std::size_t i = 0; i < graph.lines.size(); ++i) {
      const CentreLine& line = graph.lines[i];
      if (line.first == line.last || length_px(line.points) < options.least_length * 2.0 * line.radius_px)
        continue;
      radius[i] = fork_radius(graph, i, options);
      if (radius[i] == 0.0 && widest_other > 0.0 && line.radius_px >= options.width_ratio * widest_other)
        radius[i] = std::max(widest_other, 0.5 * line.radius_px);
      const bool is_broad = line.radius_px > options.most_widths * radius[i];
      if (is_broad || line.radius_px - radius[i] < options.least_offset_px) radius[i] = 0.0;
    }
    for (std::size_t i = 0; i < radius.size(); ++i)
      if (radius[i] > 0.0) divide(graph, i, radius[i], degrees);
  }
}

}  // namespace palpable::vision
