// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/draw/figure.hpp"
#include "palpable/draw/heading.hpp"
#include "palpable/models/relief/relief.hpp"

#include <vector>

namespace palpable::draw {

/// The force in the plane of the picture that a resting hand feels at one place.
struct ForceArrow {
  double x_m = 0.0;
  double y_m = 0.0;
  double fx_N = 0.0;
  double fy_N = 0.0;
};

/// Arrows over the paled picture, with an arrow of known size as the legend. `arrows` stand on a regular grid
/// `spacing_m` apart; where a force would reach over its neighbours it is drawn short and red, and the legend
/// says from which force on. `texture` may be empty.
Figure force_figure(models::Relief relief, const Raster<Rgb8>& texture, std::vector<ForceArrow> arrows,
                    double spacing_m, const Heading& heading);

}  // namespace palpable::draw
