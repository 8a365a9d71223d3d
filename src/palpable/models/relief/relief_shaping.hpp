// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

namespace palpable::models {

/// Limits the slope of a grid of heights (metres, all finite) to `steepest_slope` > 0. A step becomes a ramp
/// of that slope, centred on the step: the high side is cut and the low side filled, each as little as
/// possible, starting from the mean level (the mean of McShane's and Whitney's extensions, 1934). Heights
/// away from steep places do not change. The cubic B-spline over the result also keeps the limit.
void limit_slope(Raster<float>& height_m, double pixel_m, double steepest_slope);

/// The same, but only cuts: the greatest heights below these that rise by at most `steepest_slope` > 0. A
/// step becomes a ramp that begins at its foot, so low ground beside a high object remains level.
void cut_to_slope(Raster<float>& height_m, double pixel_m, double steepest_slope);

}  // namespace palpable::models
