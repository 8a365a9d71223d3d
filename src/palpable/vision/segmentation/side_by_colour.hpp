// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>

namespace palpable::vision {

/// On which side of a surface's border a pixel lies, as far as one knows.
enum class Side : std::uint8_t { unknown, inside, outside, perhaps_inside, perhaps_outside };

/// Decides the pixels that are not sure by their colour, weighed against those of the sure pixels around on
/// either side: what is perhaps on one side changes it only where the colour clearly belongs to the other;
/// what is unknown goes where it fits better. Pixels that few sure ones surround wait until those between are
/// decided; where none are reached they stay as they are. Both rasters have the same size. The same result
/// for any number of threads.
void decide_by_colour(const Raster<Rgb8>& picture, Raster<Side>& side, const Work& work);

}  // namespace palpable::vision
