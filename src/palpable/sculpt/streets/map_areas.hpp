// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/sculpt/streets/map_grid.hpp"
#include "palpable/sculpt/streets/tactile_rules.hpp"

#include <cstddef>

#include <opencv2/core.hpp>

namespace palpable::sculpt {

/// The areas of one kind as a finger can tell them apart.
struct FeltAreas {
  cv::Mat mask;
  /// How many outlines the map has of them, how many parts are felt, and how many outlines nothing is felt
  /// of.
  std::size_t drawn = 0;
  std::size_t parts = 0;
  std::size_t left_out = 0;
};

/// Areas, their corners rounded by circles of `rounding` times the least width of a part, that keep `gap_m`
/// from the streets' grooves: those nearer to each other than the rules' gap are joined; what is narrower
/// than a part must be is left out, and so is the smaller one of two that are still too near. `special`:
/// areas that are wide enough and keep the gap; what is too near to them is left out. May be empty.
FeltAreas felt_areas(const StreetMap& map, MapArea::Kind kind, const MapGrid& grid, const cv::Mat& grooves,
                     double gap_m, const TactileRules& rules, double rounding, const cv::Mat& special = {});

}  // namespace palpable::sculpt
