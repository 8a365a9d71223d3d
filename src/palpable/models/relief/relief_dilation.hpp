// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::models {

/// Dilates a relief by a ball: returns the control values of the surface that the centre of a ball follows
/// when it rolls over the relief. This is the Minkowski sum of surface and ball, max over |d| <= r of z(p +
/// d) + sqrt(r^2 - |d|^2), solved at each sample from the contact that the best sample below the ball leads
/// to, and from those of the neighbours that promise more. On constant slopes and round tops the spline is
/// within a few micrometres of the sum. In a crease, which a spline with these pixels cannot represent, it is
/// too high by up to a fifth of the pixel times the change of slope, and too low beside it by up to a tenth.
/// 0 < radius_m <= 0.02. Takes up to 40 bytes a sample meanwhile. Long work: reports progress, polls cancel;
/// what it returns after a cancel is unfinished.
Raster<float> dilate_by_ball(const Relief& relief, double radius_m, const Work& work);

/// Erodes a relief by a ball that rolls below the surface: the points at that distance below it. Work as
/// dilate_by_ball().
Raster<float> erode_by_ball(const Relief& relief, double radius_m, const Work& work);

}  // namespace palpable::models
