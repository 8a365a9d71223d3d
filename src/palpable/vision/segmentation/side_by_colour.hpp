// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/segmentation/ground_options.hpp"

#include <cstdint>

namespace palpable::vision {

/// The side of a surface's border on which a pixel lies; "perhaps" is a prior that colour may overrule.
enum class Side : std::uint8_t { unknown, inside, outside, perhaps_inside, perhaps_outside };

/// Classifies the undecided pixels by comparing their colour with those of decided pixels nearby on both
/// sides. "perhaps" changes only if the colour clearly belongs to the other side; "unknown" takes the better
/// side. Pixels with too few decided neighbours wait until those between are decided, and otherwise do not
/// change. Both rasters have the same size. The result does not depend on the number of threads.
void decide_by_colour(const Raster<Rgb8>& picture, Raster<Side>& side, const Work& work,
                      const ColourDecisionOptions& options = {});

}  // namespace palpable::vision
