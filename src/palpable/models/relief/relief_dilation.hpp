// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/ball_contact.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::models {

/// Rolls a ball over a relief: its contact with the ball's centre above each sample, which is the maximum
/// over |d| <= r of z(p + d) + sqrt(r^2 - |d|^2), solved to a fraction of a pixel. 0 < radius_m <= 0.02; the
/// time is proportional to the squared radius in pixels.
Raster<BallContact> roll_ball(const Relief& relief, double radius_m, const Work& work);

/// The control values of a spline through the heights of a ball that rolled over `relief`.
Raster<float> control_values_of(const Raster<BallContact>& contacts, const Relief& relief, double radius_m);

/// Dilates a relief by a ball: returns the control values of the surface that the centre of a ball follows
/// when it rolls over the relief (the Minkowski sum of surface and ball). On constant slopes and round tops
/// the spline is within a few micrometres of the sum. In a crease, which a spline with these pixels cannot
/// represent, it is too high by up to half the pixel times the slope, and up to a fifth steeper;
/// RefinedRelief (refined_dilation.hpp) represents creases too.
Raster<float> dilate_by_ball(const Relief& relief, double radius_m, const Work& work);

/// Erodes a relief by a ball that rolls below the surface: the points at that distance below it.
Raster<float> erode_by_ball(const Relief& relief, double radius_m, const Work& work);

}  // namespace palpable::models
