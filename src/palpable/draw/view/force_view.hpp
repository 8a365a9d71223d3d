// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"
#include "palpable/models/relief/relief.hpp"

#include <vector>

namespace palpable::draw {

/// The in-plane force on a resting hand at one position (scene frame).
struct ForceArrow {
  double x_m = 0.0;
  double y_m = 0.0;
  double fx_N = 0.0;
  double fy_N = 0.0;
};

/// Arrows over a pale version of `texture` (may be empty), with an arrow of known force as the legend.
/// `arrows` lie on a regular grid with `spacing_m`. A force whose arrow would cover its neighbours is drawn
/// shortened and red; the legend gives that limit.
Figure force_figure(models::Relief relief, const Raster<Rgb8>& texture, std::vector<ForceArrow> arrows,
                    double spacing_m, const FigureTitle& title);

}  // namespace palpable::draw
