// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"

namespace palpable::vision {

/// How disparities are refined by the pictures' luma.
struct PhotometricShiftOptions {
  /// Rounds of measuring and fitting; 0 … 20.
  int rounds = 2;
  /// Where a shift is measured: pixels of one plane agree about it almost whatever their colour.
  FitWindow measured = {.radius_px = 4, .step_px = 1, .half_weight_levels = 30.0F};
  /// Where planes are fitted through the shifted pixels.
  FitWindow carried = {.radius_px = 6, .step_px = 2};
  PlaneFitOptions fit = {};
  /// The largest shift; px, 0 … 2.
  float largest_px = 0.5F;
  /// Standard deviation of the shift that is expected where nothing is measured; px, 0.01 … 10.
  float expected_px = 0.3F;
  /// Variance of luma that no shift explains, noise and rounding of both pictures; levels², 0.01 … 1000.
  float noise_variance = 2.0F;
  /// Neighbouring pixels have similar errors: this share of them counts as independent; 0.001 … 1.
  float independent_share = 0.25F;
  /// A difference of luma has half its weight here; levels of 255, 1 … 255.
  float half_weight_residual = 10.0F;
  /// Below this sum of weights, or this variance of the gradient, nothing is measured; 0 … 1000, levels² per
  /// px².
  float least_weight = 1.0F;
  float least_gradient_variance = 1e-3F;
};
std::vector<Parameter> parameters_of(PhotometricShiftOptions& options);

/// Matching costs at whole disparities pull the disparities between them towards them: slanted surfaces
/// become terraces. Moves each disparity to where the other picture's luma, interpolated by a cubic, fits
/// best by least squares over the pixels around that lie on the same surface (after Lucas & Kanade 1981),
/// whatever the difference in brightness. A shift is weighted by its variance against that of an unmeasured
/// one, and planes through the shifted pixels, with these weights, continue the shift to where the pictures
/// have too little texture.
///
/// `luma`, `other`: the two pictures' luma; x in `luma` matches x - d in `other`, whose own disparities are
/// `other_disparity`, infinite where that picture shows nothing. Only pixels that both views agree about are
/// measured, without the edges of nearer surfaces. The same result for any number of threads.
void shift_between_pixels(const ColourPlanes& colour, const Raster<std::uint8_t>& luma,
                          const Raster<std::uint8_t>& other, const Raster<float>& other_disparity,
                          const PhotometricShiftOptions& options, PlaneMap& map, const Work& work);

}  // namespace palpable::vision
