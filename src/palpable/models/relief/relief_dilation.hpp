// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::models {

/// Dilates a relief by a ball: returns the control values of the surface that the centre of a ball follows
/// when it rolls over the relief. This is the Minkowski sum of surface and ball, max over |d| <= r of z(p +
/// d) + sqrt(r^2 - |d|^2), solved to a fraction of a pixel at each sample. On constant slopes and round tops
/// the spline is within a few micrometres of the sum. In a crease, which a spline with these pixels cannot
/// represent, it is too high by up to a ninth of the pixel times the slope, and up to a fifth steeper. 0 <
/// radius_m <= 0.02. Long work: reports progress, polls cancel; what it returns after a cancel is unfinished.
Raster<float> dilate_by_ball(const Relief& relief, double radius_m, const Work& work);

/// Erodes a relief by a ball that rolls below the surface: the points at that distance below it. Work as
/// dilate_by_ball().
Raster<float> erode_by_ball(const Relief& relief, double radius_m, const Work& work);

}  // namespace palpable::models
