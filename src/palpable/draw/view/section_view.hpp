// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::draw {

/// A section through the relief in the plane y = `y_m`: the profile, and a small map that shows the section's
/// position. Low profiles are exaggerated vertically by a factor that the figure states.
Figure section_figure(models::Relief relief, double y_m, const FigureTitle& title);

}  // namespace palpable::draw
