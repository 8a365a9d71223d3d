// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/cost_volume.hpp"

namespace palpable::vision {

/// Semi-global aggregation over four paths (left, right, up, down; Hirschmueller 2008, eq. 13) with the
/// penalties of Mei et al. 2011 (section 3.3): 1 unit for a step of one disparity, 3 for more, a quarter of
/// it where one of the pictures has an edge between the pixels, a tenth where both have. `sums` gets the sum
/// of the four path costs in units of 1/kCostUnit and must have the volume's sizes. The same result for any
/// number of threads.
void aggregate_paths(const CostVolume& costs, const ColourPlanes& reference, const ColourPlanes& other,
                     CostVolume& sums, const Work& work);

/// The disparity of least cost at each pixel, sub-pixel by the parabola through its neighbours.
Raster<float> least_cost_disparity(const CostVolume& costs, const Work& work);

}  // namespace palpable::vision
