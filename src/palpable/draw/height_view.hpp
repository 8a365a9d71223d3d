// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/draw/figure.hpp"
#include "palpable/draw/figure_title.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::draw {

/// A relief as a height map: tinted by height and shaded as if lit from the upper left, with height lines,
/// axes and scale in millimetres. If `picture` is given, it covers the relief's rectangle and replaces the
/// tints.
Figure relief_figure(models::Relief relief, const FigureTitle& title, Raster<Rgb8> picture = {});

/// The heights of a relief in a linear colour scale without shading, so that values can be read off.
Figure height_figure(models::Relief relief, const FigureTitle& title);

/// A depth or disparity map in a linear colour scale, axes in pixels; values that are not finite are hatched.
/// `value_name` is the legend's name with its unit. Near is pale: Near::high for disparity, Near::low for
/// depth.
enum class Near { low, high };
Figure depth_figure(Raster<float> values, const std::string& value_name, Near near, const FigureTitle& title);

}  // namespace palpable::draw
