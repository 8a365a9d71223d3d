// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"

namespace palpable::draw {

/// Boundaries one pixel wide (`lines`: strength 0 … 1, 0 = none) over a pale version of their picture.
/// Stronger lines are darker. Axes in millimetres, pixels of pixel_m. The picture may be empty or of another
/// size.
Figure contours_figure(Raster<float> lines, Raster<Rgb8> picture, double pixel_m, const FigureTitle& title);

}  // namespace palpable::draw
