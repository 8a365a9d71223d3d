// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"

// Votes of the planes around a pixel, carried on to it: those near and alike in colour weigh most (after
// Bleyer, Rhemann & Rother 2011, section 3.4). `other_disparity` is the other view's, in its own frame: the
// match of its pixel x lies at x + d here; infinite where it shows nothing.
namespace palpable::vision {

/// Carries surfaces on over what something nearer hides from the other camera, or what lies out of its view.
/// No colour of the other picture holds a disparity there, so the search leaves slopes between the nearer
/// surface and the one behind it. The planes with which the pixel would be hidden or out of view vote, those
/// of pixels that both views agree about first, round by round inwards; of them the further third wins, out
/// of view the median. Slopes are carried on with the disparities.
void carry_behind(const ColourPlanes& colour, const Raster<float>& other_disparity, PlaneMap& map,
                  const Work& work);

/// The map's disparities, but what the two views disagree about, without one hiding it from the other, is the
/// median of the votes of the agreed pixels around it.
Raster<float> settled(const ColourPlanes& colour, const Raster<float>& other_disparity, const PlaneMap& map,
                      const Work& work);

}  // namespace palpable::vision
