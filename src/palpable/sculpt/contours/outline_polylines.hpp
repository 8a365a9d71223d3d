// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"

#include <vector>

namespace palpable::sculpt {

struct OutlineOptions {
  /// Shorter lines are omitted, since a finger does not find them. 0 … 0.1 m.
  double least_length_m = 0.004;
  /// Greatest distance of an omitted point from the simplified line (Douglas & Peucker 1973). 0 … 0.01 m.
  double tolerance_m = 0.0002;
};
std::vector<Parameter> parameters_of(OutlineOptions& options);

/// One-pixel-wide lines (`line` > 0) as polylines in the scene's plane. Each pixel belongs to one polyline;
/// polylines begin and end at line ends and junctions. The raster is centred on the origin, y up. The
/// options must be in their ranges.
std::vector<Polyline> outline_polylines(const Raster<float>& line, double pixel_m,
                                        const OutlineOptions& options = {});

}  // namespace palpable::sculpt
