// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::draw {

/// A relief as a height map: tinted by height and shaded as if lit from the upper left, with height lines,
/// axes and scale in millimetres. If `picture` is given, it covers the relief's rectangle and replaces the
/// tints.
Figure relief_figure(models::Relief relief, const FigureTitle& title, Raster<Rgb8> picture = {});

/// The heights of a relief in a linear colour scale without shading, so that values can be read off.
Figure height_figure(models::Relief relief, const FigureTitle& title);

}  // namespace palpable::draw
