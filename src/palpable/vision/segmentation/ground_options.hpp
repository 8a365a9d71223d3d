// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"

#include <vector>

// Parameters of the ground's detection. Defaults were chosen on drawn scenes with known ground and on
// Middlebury and RGB-D pictures with marked ground (docs/measurements.md). Distances are pixels of disparity.
namespace palpable::vision {

/// The robust fit of the plane.
struct GroundPlaneOptions {
  /// Approximate number of known pixels, on a regular grid, for finding planes and for refining them. 100 …
  /// 1e6.
  double searched_samples = 6000.0;
  double fitted_samples = 60000.0;
  /// Random triples of samples; the second and third lie within this share of the picture's longer side of
  /// the first; the best different planes are refined. 10 … 100000; 0.01 … 2; 1 … 100.
  int trials = 3000;
  double reach_share = 0.3;
  int refined_planes = 8;
  /// Inlier tolerance of the search. 0.05 … 10 px.
  double tolerance_px = 0.75;
  /// A ground's disparity rises from the top of the picture to its bottom by at least this much, and this
  /// share of the range of disparities; its slope across is at most this much of that down (camera roll).
  /// 0 … 100 px; 0 … 1; 0 … 10.
  double least_rise_px = 2.0;
  double least_rise_share = 0.12;
  double most_roll = 0.6;
  /// A pixel under a plane counts as minus this many inliers. 0 … 10.
  double under_penalty = 0.5;
  /// Tukey's biweight: iterations, its constant, limits of the standard deviation, and the farthest pixel
  /// that the deviation is estimated from. 1 … 100; 1 … 20; > 0 … 10 px each.
  int iterations = 12;
  double biweight = 4.685;
  double least_sigma_px = 0.02;
  double most_sigma_px = 0.35;
  double near_px = 1.5;
  /// A ground contains at least this share of the known pixels, and its disparity rises by at least this much
  /// and this many standard deviations, since noise tilts level planes and walls. 0 … 1; 0 … 100 px; 0 … 100.
  double least_share = 0.05;
  double least_held_rise_px = 1.0;
  double least_held_rise_sigmas = 6.0;
};

std::vector<Parameter> parameters_of(GroundPlaneOptions& options);

/// Pixels near a border between two surfaces, decided by colour (side_by_colour.hpp).
struct ColourDecisionOptions {
  /// Decided pixels that are compared: within the reach to each side, every n-th; with fewer than the least
  /// nothing is decided. 1 … 200 px; 1 … 16 px; 1 … 10000.
  int reach_px = 24;
  int step_px = 2;
  int least_pixels = 24;
  /// Colour difference at which the likelihood falls to 1/e; levels of 255. > 0 … 255.
  float colour_scale = 8.0F;
  /// Least likelihood ratio that changes a pixel's assumed side. 1 … 1000.
  float prior_ratio = 5.0F;
  /// Likelihood of a colour that a side does not have. > 0 … 1.
  float least_density = 0.01F;
};
std::vector<Parameter> parameters_of(ColourDecisionOptions& options);

/// Assignment of pixels to a fitted plane.
struct GroundMaskOptions {
  /// Complexity of the colour regions (merge_regions). 1 … 1024.
  double region_complexity = 32.0;
  /// Tolerance in standard deviations, and its least value. 0.1 … 20; 0 … 10 px.
  double sigmas = 2.0;
  double least_tolerance_px = 0.12;
  /// A neighbourhood (pixels to each side) is measured over pixels this many tolerances, and at least this
  /// much, from the plane. 1 … 50 px; 1 … 20; 0 … 10 px.
  int neighbourhood_px = 5;
  double near_tolerances = 4.0;
  double least_near_px = 0.5;
  /// A surface that rises from the plane by more than this share of the plane's own slope per row is an
  /// object's foot. 0 … 2.
  double most_rise_share = 0.5;
  /// A region of which at least mostly_share lies on the plane includes its pixels up to far_px off the
  /// plane. 0 … 1; 0 … 20 px.
  double mostly_share = 0.8;
  double far_px = 1.0;
  /// Half the window of the majority filter. 0 … 20 px.
  int majority_px = 2;
  /// Width of the strip at borders in which colour decides, for disparity that was matched. 1 … 100 px.
  int border_px = 8;
  /// A pixel is occluded if the other camera sees a surface nearer by this much. 0 … 20 px.
  double hidden_px = 1.0;
  /// The ground's far end, without this share of its pixels. 0 … 0.5.
  double far_end_share = 0.01;
};
std::vector<Parameter> parameters_of(GroundMaskOptions& options);

struct GroundOptions {
  GroundPlaneOptions plane;
  GroundMaskOptions mask;
  ColourDecisionOptions colour;
  /// A ground covers at least this share of the picture. 0 … 1.
  double least_share = 0.05;
};
std::vector<Parameter> parameters_of(GroundOptions& options);

}  // namespace palpable::vision
