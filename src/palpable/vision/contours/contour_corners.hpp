// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/contours/contour_options.hpp"

namespace palpable::vision {

/// Restores corners that blurring has rounded off: where two straight pieces of a line meet at an angle, the
/// pixels between them are replaced by both pieces' extensions to their intersection, if that is near. Arcs,
/// junctions and curved pieces do not change. `line` is the result of ridge_lines() for `strength` and the
/// unit tangents.
void restore_corners(const Raster<float>& strength, const Raster<float>& tangent_x,
                     const Raster<float>& tangent_y, Raster<float>& line, const CornerOptions& options,
                     const Work& work);

}  // namespace palpable::vision
