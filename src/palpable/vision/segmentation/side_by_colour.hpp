// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/segmentation/ground_options.hpp"

#include <cstdint>

namespace palpable::vision {

/// On which side of a surface's border a pixel lies; "perhaps" is a prior that colour may overrule.
enum class Side : std::uint8_t { unknown, inside, outside, perhaps_inside, perhaps_outside };

/// Decides the undecided pixels by comparing their colour with those of the decided pixels around, on either
/// side: "perhaps" is changed only where the colour clearly belongs to the other side; "unknown" goes where
/// it fits better. Pixels with too few decided ones around wait until those between are decided; where none
/// are reached they stay as they are. Both rasters have the same size. The same result for any number of
/// threads.
void decide_by_colour(const Raster<Rgb8>& picture, Raster<Side>& side, const Work& work,
                      const ColourDecisionOptions& options = {});

}  // namespace palpable::vision
