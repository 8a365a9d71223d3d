// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::models {

/// The control values of the surface on which the centre of a ball stays that rolls over a relief: the
/// Minkowski sum of surface and ball, max over |d| <= r of z(p + d) + sqrt(r^2 - |d|^2), found to a fraction
/// of a pixel at each sample. On even slopes and round tops the spline through them is within a few
/// micrometres of the sum; in a crease, which no spline of the same pixels can hold, it is too high by up to
/// a ninth of the pixel times the slope, and up to a fifth steeper. 0 < radius_m <= 0.02; the work grows with
/// the radius in pixels squared.
Raster<float> dilate_by_ball(const Relief& relief, double radius_m, const Work& work);

/// The same for a ball under the surface: the places at that depth below it.
Raster<float> erode_by_ball(const Relief& relief, double radius_m, const Work& work);

}  // namespace palpable::models
