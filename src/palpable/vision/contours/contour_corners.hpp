// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"

namespace palpable::vision {

/// Draws the lines out to their corners, where blurring has rounded them off: where two straight pieces of a
/// line (3.5 to 10 px from the corner) meet at 30 to 150 degrees, the pixels between them are replaced by
/// both pieces' prolongations to their meeting, which lies within 3 px. Arcs, junctions and pieces that are
/// not straight stay as they are. `line` is as ridge_lines() finds it on `strength` and the unit tangents.
void draw_out_corners(const Raster<float>& strength, const Raster<float>& tangent_x,
                      const Raster<float>& tangent_y, Raster<float>& line, const Work& work);

}  // namespace palpable::vision
