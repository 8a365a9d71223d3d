// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"

#include <vector>

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

/// A window around a pixel whose pixels are weighted by their likelihood of belonging to the same surface.
struct FitWindow {
  /// The window's reach to each side; px, 1 … 60.
  int radius_px = 3;
  /// Every n-th row and column of the window is used; px, 1 … 16.
  int step_px = 1;
  /// The colour difference, in the channel that differs most, at which a weight is half; levels of 255, 1 …
  /// 255.
  float half_weight_levels = 12.0F;
  /// A disparity at this distance from the centre's plane has no weight; px, 0.05 … 10 …
  float tolerance_px = 1.0F;
  /// … increased by this for each pixel of distance (city block); px, 0 … 1.
  float tolerance_per_px = 0.04F;
};
std::vector<Parameter> parameters_of(FitWindow& window);

/// Limits of fitted planes.
struct PlaneFitOptions {
  /// The plane is not refitted if the window's weights sum to this or less; 0 … 100.
  float least_weight = 3.0F;
  /// Added to the variances of the window's coordinates, against slopes from too few pixels; px², 0 … 10.
  float ridge_px2 = 0.05F;
  /// The steepest slope; px of disparity per px, 0 … 4.
  float steepest = 1.5F;
  /// The steepest rise to the right, beyond which a surface is hidden from the other camera; px per px, 0 …
  /// 0.99.
  float steepest_rise = 0.9F;
};
std::vector<Parameter> parameters_of(PlaneFitOptions& options);

/// The planes of one view in the other view's frame: each is moved to its match, with slopes relative to the
/// other picture. The nearest wins if several map to one pixel; NaN if none does. Both views are oriented as
/// left pictures, each the other's mirror image: (x, y) here matches (width - 1 - x + d, y) there.
PlaneMap planes_in_other_view(const PlaneMap& map, const PlaneFitOptions& fit, const Work& work);

/// Fits a plane at each pixel to the disparities around it by weighted least squares; the weights are the
/// window's and `weight`, 0…1. With too little support the plane does not change.
PlaneMap fit_planes(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight,
                    const FitWindow& window, const PlaneFitOptions& fit, const Work& work);

}  // namespace palpable::vision
