// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"

namespace palpable::vision {

/// Matching costs at whole disparities pull what lies between them towards them: slanted surfaces become
/// terraces. Moves each disparity, by at most half a pixel, to where the other picture's luma, read between
/// pixels by a cubic, fits best by least squares over the like-coloured pixels around that lie on the same
/// surface (after Lucas & Kanade 1981), whatever the difference in brightness. Each shift counts as much as
/// the pictures say for it: shift and weight follow from its variance beside that of an unmeasured one, and
/// planes through the shifted pixels, so weighted, carry the shift to where the pictures say little.
///
/// `luma`, `other`: the two pictures' luma; x in `luma` matches x - d in `other`, whose own disparities are
/// `other_disparity`, infinite where that picture shows nothing. Only what both agree about, edges of nearer
/// things left out, is measured. The same result for any number of threads.
void shift_between_pixels(const ColourPlanes& colour, const Raster<std::uint8_t>& luma,
                          const Raster<std::uint8_t>& other, const Raster<float>& other_disparity,
                          PlaneMap& map, const Work& work);

}  // namespace palpable::vision
