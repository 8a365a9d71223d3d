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

/// Smooths heights: three means over squares of 2 radius_px + 1 pixels, one after the other, which is close
/// to a Gaussian of sqrt(radius_px (radius_px + 1)) pixels. Beyond the border its heights continue. radius_px
/// >= 0.
void smooth_heights(Raster<float>& height_m, int radius_px);

/// The greatest curvature of a grid of heights, 1/m: the largest eigenvalue of the second differences by
/// size.
double greatest_bend_per_m(const Raster<float>& height_m, double pixel_m);

}  // namespace palpable::models
