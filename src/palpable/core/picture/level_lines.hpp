// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <vector>

namespace palpable {

/// A point between the samples of a raster: x in columns, y in rows; sample (0, 0) is at the origin.
struct RasterPoint {
  double x = 0.0, y = 0.0;
};

/// The lines on which the linearly interpolated samples have this value (marching squares; Lorensen & Cline
/// 1987 in the plane). A closed line ends at its first point. In a cell whose opposite corners lie on one
/// side of the level, the mean of the four decides which corners are connected. The values must be finite.
std::vector<std::vector<RasterPoint>> level_lines(const Raster<float>& values, double level);

}  // namespace palpable
