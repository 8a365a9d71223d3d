// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/map_clip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace palpable {
namespace {

std::optional<std::pair<MapPoint, MapPoint>> part_in_window(MapPoint a, MapPoint b, MapPoint most) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  double first = 0.0;
  double last = 1.0;
  for (const auto& [p, q] : {std::pair{-dx, a.x}, {dx, most.x - a.x}, {-dy, a.y}, {dy, most.y - a.y}}) {
    if (p == 0.0 && q < 0.0) return std::nullopt;
    if (p < 0.0) first = std::max(first, q / p);
    if (p > 0.0) last = std::min(last, q / p);
  }
  if (first > last) return std::nullopt;
  return std::pair{MapPoint{a.x + first * dx, a.y + first * dy}, MapPoint{a.x + last * dx, a.y + last * dy}};
}

}  // namespace

std::vector<std::vector<MapPoint>> parts_in_window(const std::vector<MapPoint>& line, MapPoint most) {
  std::vector<std::vector<MapPoint>> parts;
  bool goes_on = false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto part = part_in_window(line[i - 1], line[i], most);
    if (!part) {
      goes_on = false;
      continue;
    }
    if (!goes_on) parts.push_back({part->first});
    parts.back().push_back(part->second);
    goes_on = part->second.x == line[i].x && part->second.y == line[i].y;
  }
  constexpr double kShortest_px = 1.0;
  std::erase_if(parts, [](const std::vector<MapPoint>& part) {
    double length = 0.0;
    for (std::size_t i = 1; i < part.size(); ++i)
      length += std::hypot(part[i].x - part[i - 1].x, part[i].y - part[i - 1].y);
    return length < kShortest_px;
  });
  return parts;
}

std::vector<MapPoint> ring_in_window(std::vector<MapPoint> ring, MapPoint most) {
  using Side = std::function<double(MapPoint)>;
  const std::array<Side, 4> sides{[](MapPoint p) { return p.x; }, [most](MapPoint p) { return most.x - p.x; },
                                  [](MapPoint p) { return p.y; },
                                  [most](MapPoint p) { return most.y - p.y; }};
  for (const Side& inside : sides) {
    std::vector<MapPoint> kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const MapPoint a = ring[i];
      const MapPoint b = ring[(i + 1) % ring.size()];
      const double of_a = inside(a);
      const double of_b = inside(b);
      if (of_a >= 0.0) kept.push_back(a);
      if ((of_a >= 0.0) == (of_b >= 0.0)) continue;
      const double t = of_a / (of_a - of_b);
      kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
    ring = std::move(kept);
  }
  return ring;
}

}  // namespace palpable
