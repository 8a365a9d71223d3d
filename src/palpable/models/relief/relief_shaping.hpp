// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"

namespace palpable::models {

/// Brings a grid of heights (metres, all finite) to slopes of at most `steepest_slope`. A step becomes a ramp
/// of that slope, centred on the step: the high side is cut and the low side filled, each as little as the
/// slope allows, from the level half-way between (the mean of McShane's and Whitney's extensions, 1934). What
/// is not too steep, nor near what is, stays as it is. The cubic B-spline over the result keeps the limit
/// too. steepest_slope > 0.
void limit_slope(Raster<float>& height_m, double pixel_m, double steepest_slope);

/// The surface on which the centre of a ball stays that rolls over the heights: the exact Minkowski sum with
/// the ball on the grid, max over |d| <= r of z(p + d) + sqrt(r^2 - |d|^2); heights beyond the border
/// continue level. A radius of 0 gives the heights themselves. radius_m <= 0.02; the work grows with the
/// radius in pixels squared.
Raster<float> dilate_by_ball(const Raster<float>& height_m, double pixel_m, double radius_m,
                             const Work& work);

}  // namespace palpable::models
