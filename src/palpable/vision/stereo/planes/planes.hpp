// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"

namespace palpable::vision {

/// A plane of disparity at each pixel: its value there and its slopes in pixels of disparity per pixel.
struct PlaneMap {
  Raster<float> disparity;
  Raster<float> slope_x;
  Raster<float> slope_y;

  PlaneMap() = default;
  PlaneMap(int width, int height)
      : disparity(width, height), slope_x(width, height), slope_y(width, height) {}
};

struct FitWindow {
  /// The window reaches this many pixels to each side,
  int radius_px = 3;
  /// and takes every so-manieth.
  int step_px = 1;
  /// What differs by so many levels, in the channel that differs most, counts half.
  float like_colour = 12.0F;
};

/// The planes of one view of a pair as the other sees them: each moved to the pixel where it matches, its
/// slopes those over the other picture, the nearest where several fall; NaN where none does. Views are kept
/// as matching wants them, each the other's mirror image: (x, y) here matches (width - 1 - x + d, y) there.
PlaneMap planes_across(const PlaneMap& map, const Work& work);

/// Fits a plane at each pixel to the disparities around it, each weighted by how alike its colour is, how
/// little it departs from the plane that the pixel has now (none beyond about a pixel), and by `weight`, 0…1.
/// Where too little supports it the plane stays as it is.
PlaneMap fit_planes(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight,
                    FitWindow window, const Work& work);

}  // namespace palpable::vision
