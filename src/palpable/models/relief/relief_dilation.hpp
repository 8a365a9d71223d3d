// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/finer_fit.hpp"
#include "palpable/models/relief/refined_relief.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::models {

/// The surface that the centre of a ball follows when it rolls over a relief: the Minkowski sum of surface
/// and ball, max over |d| <= r of z(p + d) + sqrt(r^2 - |d|^2), with finer cells where a spline with the
/// relief's pixels cannot follow it, as in a crease between two walls that the ball touches at once. Within a
/// few micrometres on reliefs with slopes up to 3 (FinerFit), except within two pixels of the border. 0 <
/// radius_m
/// <= 0.02. Long work: reports progress, polls cancel. Errors: interrupted.
Result<RefinedRelief> surface_of_ball(const Relief& relief, double radius_m, const FinerFit& fit,
                                      const Work& work);

/// The same as control values of a spline with the relief's pixels, faster and less exact: only the best
/// contact at each sample is searched. On constant slopes and round tops the spline is within a few
/// micrometres of the sum. In a crease it is too high by up to half a pixel times the slope, and on rough
/// reliefs also too low. Long work: reports progress, polls cancel; what it returns after a cancel is
/// unfinished.
Raster<float> dilate_by_ball(const Relief& relief, double radius_m, const Work& work);

/// The surface of dilate_by_ball(). Errors: interrupted.
Result<RefinedRelief> coarse_surface_of_ball(const Relief& relief, double radius_m, const Work& work);

/// Erodes a relief by a ball that rolls below the surface: the points at that distance below it. Work as
/// dilate_by_ball().
Raster<float> erode_by_ball(const Relief& relief, double radius_m, const Work& work);

}  // namespace palpable::models
