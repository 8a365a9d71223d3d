// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"

namespace palpable::vision {

/// How disparities are refined by the pictures' luma.
struct PhotometricShiftOptions {
  /// Rounds of measuring and fitting; 0 … 20.
  int rounds = 2;
  /// Window in which a shift is measured: pixels of one plane agree on it almost independent of colour.
  FitWindow shift_window = {.radius_px = 4, .step_px = 1, .half_weight_levels = 30.0F};
  /// Window in which planes are fitted to the shifted pixels.
  FitWindow fit_window = {.radius_px = 6, .step_px = 2};
  PlaneFitOptions fit = {};
  /// The largest shift; px, 0 … 2.
  float largest_px = 0.5F;
  /// Prior standard deviation of the shift; px, 0.01 … 10.
  float expected_px = 0.3F;
  /// Noise variance of luma from noise and rounding of both pictures; levels², 0.01 … 1000.
  float noise_variance = 2.0F;
  /// Neighbouring pixels have similar errors: this share of them counts as independent; 0.001 … 1.
  float independent_share = 0.25F;
  /// Luma difference at which a weight is half; levels of 255, 1 … 255.
  float half_weight_residual = 10.0F;
  /// Below this sum of weights nothing is measured; 0 … 1000.
  float least_weight = 1.0F;
  /// Below this variance of the gradient nothing is measured; levels²/px², 0 … 1000.
  float least_gradient_variance = 1e-3F;
};
std::vector<Parameter> parameters_of(PhotometricShiftOptions& options);

/// Refines disparities photometrically. Costs at integer disparities bias sub-pixel disparities towards
/// integers (pixel locking), so that slanted surfaces become terraces. Each disparity is shifted to the
/// least-squares fit of the other picture's luma (cubic interpolation) over nearby pixels of the same surface
/// (after Lucas & Kanade 1981), with any brightness offset. A shift is weighted by its variance relative to a
/// prior, and planes fitted to the shifted pixels with these weights extend the shift to untextured areas.
///
/// `luma`, `other`: the two pictures' luma; x in `luma` matches x - d in `other`, whose own disparities are
/// `other_disparity`, infinite where that picture has no content. Only pixels that pass the left-right check
/// are measured, without the edges of nearer surfaces. The result does not depend on the number of threads.
void refine_photometrically(const ColourPlanes& colour, const Raster<std::uint8_t>& luma,
                            const Raster<std::uint8_t>& other, const Raster<float>& other_disparity,
                            const PhotometricShiftOptions& options, PlaneMap& map, const Work& work);

}  // namespace palpable::vision
