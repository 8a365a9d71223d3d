// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"

namespace palpable::models {

/// Limits the slope of a grid of heights (metres, all finite) to `steepest_slope` > 0. A step becomes a ramp
/// of that slope, centred on the step: the high side is cut and the low side filled, each as little as
/// possible, starting from the mean level (the mean of McShane's and Whitney's extensions, 1934). Heights
/// away from steep places do not change. The cubic B-spline over the result also keeps the limit.
void limit_slope(Raster<float>& height_m, double pixel_m, double steepest_slope);

/// The surface of the centre of a ball that rolls over the heights: the exact Minkowski sum with the ball on
/// the grid, max over |d| <= r of z(p + d) + sqrt(r^2 - |d|^2). Heights beyond the border continue level. A
/// radius of 0 returns the heights. radius_m <= 0.02; the cost is quadratic in the radius in pixels.
Raster<float> dilate_by_ball(const Raster<float>& height_m, double pixel_m, double radius_m,
                             const Work& work);

}  // namespace palpable::models
