// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/segmentation/regions.hpp"
#include "palpable/vision/stereo/planes/planes.hpp"

#include <array>
#include <vector>

namespace palpable::vision {

/// A plane of disparity over the whole picture: its value at the pixel (0, 0) and its slopes.
struct RegionPlane {
  float at_origin = 0.0F;
  float slope_x = 0.0F;
  float slope_y = 0.0F;
  float at(int x, int y) const {
    return at_origin + slope_x * static_cast<float>(x) + slope_y * static_cast<float>(y);
  }
};

/// The two planes that most of a region's pixels lie on; the same one twice where there is one.
using RegionPlanes = std::vector<std::array<RegionPlane, 2>>;

/// The planes of every region, out of those that the pixels of the map have; `trust` weighs the pixels, 0 …
/// 1. A surface that has spread beyond its edge over a piece of a region of one colour is thereby offered the
/// plane that most of the region lies on, at all its pixels at once; pixel by pixel it would not shrink. The
/// same result for any number of threads.
RegionPlanes planes_of_regions(const Regions& regions, const PlaneMap& map, const Raster<float>& trust,
                               const Work& work);

}  // namespace palpable::vision
