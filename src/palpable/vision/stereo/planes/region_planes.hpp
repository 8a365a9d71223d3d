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

/// Parameters of a region's planes.
struct RegionPlaneOptions {
  /// A pixel lies on a plane if its disparity differs by less; px, 0.05 … 10.
  float on_plane_px = 0.7F;
  /// Planes tried in each region; 1 … 1000.
  int tried_planes = 24;
  /// Pixels of each region that the planes are compared with; 1 … 100000.
  int sampled_pixels = 400;
};
std::vector<Parameter> parameters_of(RegionPlaneOptions& options);

/// The two planes with most inliers in a region; the same one twice if there is only one.
using RegionPlanes = std::vector<std::array<RegionPlane, 2>>;

/// The planes of every region, selected from the planes of its pixels; `trust` weights the pixels, 0 … 1. If
/// a surface has spread beyond its edge into a region of one colour, every pixel of the region gets the
/// majority's plane as a candidate; otherwise the surface would not shrink. The result does not depend on the
/// number of threads.
RegionPlanes planes_of_regions(const Regions& regions, const PlaneMap& map, const Raster<float>& trust,
                               const RegionPlaneOptions& options, const Work& work);

}  // namespace palpable::vision
