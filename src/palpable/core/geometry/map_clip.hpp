// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"

#include <vector>

namespace palpable {

/// The parts of a line inside 0 ... most.x, 0 ... most.y that are at least a pixel long (Liang & Barsky
/// 1984).
std::vector<std::vector<MapPoint>> parts_in_window(const std::vector<MapPoint>& line, MapPoint most);

/// The part of a ring in that window (Sutherland & Hodgman 1974); empty if there is none.
std::vector<MapPoint> ring_in_window(std::vector<MapPoint> ring, MapPoint most);

}  // namespace palpable
