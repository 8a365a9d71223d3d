// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/draw/figure.hpp"
#include "palpable/draw/heading.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::draw {

/// A relief as a map of its heights: tinted by height and shaded as if lit from the upper left, with contour
/// lines, axes and scale in millimetres and the light's direction said.
/// With a `picture` (covering the relief's rectangle) its colours take the tints' place.
Figure relief_figure(models::Relief relief, const Heading& heading, Raster<Rgb8> picture = {});

/// The heights of a relief in evenly stepping colours, without shading, so that values can be read off.
Figure height_figure(models::Relief relief, const Heading& heading);

/// A depth or disparity map in evenly stepping colours, axes in pixels; what is not finite is hatched.
/// `value_name` is the legend's, with its unit. Near is pale: `near_is_high` is true for disparity.
enum class Near { low, high };
Figure depth_figure(Raster<float> values, const std::string& value_name, Near near, const Heading& heading);

}  // namespace palpable::draw
