// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/picture/raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

// Places beside a street's line. Pixels, y down. Any thread.
namespace palpable::vision {

/// The unit normal of a line at its point i, whose direction is that from `around` points before to as many
/// after it. `line` must not be empty.
inline MapPoint normal_at(std::span<const MapPoint> line, std::size_t i, std::size_t around) {
  const MapPoint before = line[i - std::min(i, around)];
  const MapPoint after = line[std::min(line.size() - 1, i + around)];
  const double length = std::max(1e-9, std::hypot(after.x - before.x, after.y - before.y));
  return {(before.y - after.y) / length, (after.x - before.x) / length};
}

inline MapPoint beside(MapPoint p, MapPoint normal, double distance) {
  return {p.x + distance * normal.x, p.y + distance * normal.y};
}

/// A raster's value at the pixel that a place is in; 0 outside.
inline std::uint8_t value_at(const Raster<std::uint8_t>& raster, MapPoint p) {
  const int x = static_cast<int>(std::lround(p.x)), y = static_cast<int>(std::lround(p.y));
  return raster.contains(x, y) ? raster(x, y) : std::uint8_t{0};
}

}  // namespace palpable::vision
