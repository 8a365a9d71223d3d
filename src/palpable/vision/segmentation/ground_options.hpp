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
  /// Approximate number of known pixels, on a regular grid, for finding planes. 100 … 1e6.
  double searched_samples = 6000.0;
  /// The same for refining them. 100 … 1e6.
  double fitted_samples = 60000.0;
  /// Number of random triples of samples. 10 … 100000.
  int trials = 3000;
  /// The second and third sample of a triple lie within this share of the picture's longer side of the first.
  /// 0.01 … 2.
  double reach_share = 0.3;
  /// Number of the best different planes that are refined. 1 … 100.
  int refined_planes = 8;
  /// Inlier tolerance of the search. 0.05 … 10 px.
  double tolerance_px = 0.75;
  /// A ground's disparity rises from the top of the picture to its bottom by at least this much. 0 … 100 px.
  double least_rise_px = 2.0;
  /// And by at least this share of the range of disparities. 0 … 1.
  double least_rise_share = 0.12;
  /// Its slope across is at most this factor of that down (camera roll). 0 … 10.
  double most_roll = 0.6;
  /// A pixel under a plane counts as minus this many inliers. 0 … 10.
  double under_penalty = 0.5;
  /// Iterations of the fit with Tukey's biweight. 1 … 100.
  int iterations = 12;
  /// Tukey's constant, in standard deviations. 1 … 20.
  double biweight = 4.685;
  /// Least standard deviation. > 0 … 10 px.
  double least_sigma_px = 0.02;
  /// Greatest standard deviation. > 0 … 10 px.
  double most_sigma_px = 0.35;
  /// The deviation is estimated from pixels that are at most this far from the plane. > 0 … 10 px.
  double near_px = 1.5;
  /// A ground contains at least this share of the known pixels. 0 … 1.
  double least_share = 0.05;
  /// The disparity of its pixels rises by at least this much, since noise tilts level planes and walls.
  /// 0 … 100 px.
  double least_held_rise_px = 1.0;
  /// And by at least this many standard deviations. 0 … 100.
  double least_held_rise_sigmas = 6.0;
};

std::vector<Parameter> parameters_of(GroundPlaneOptions& options);

/// Pixels near a border between two surfaces, decided by colour (side_by_colour.hpp).
struct ColourDecisionOptions {
  /// Decided pixels up to this far to each side are compared. 1 … 200 px.
  int reach_px = 24;
  /// Distance between the compared pixels. 1 … 16 px.
  int step_px = 2;
  /// With fewer compared pixels nothing is decided. 1 … 10000.
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
  /// Tolerance in standard deviations. 0.1 … 20.
  double sigmas = 2.0;
  /// Least tolerance. 0 … 10 px.
  double least_tolerance_px = 0.12;
  /// Pixels to each side of a neighbourhood. 1 … 50 px.
  int neighbourhood_px = 5;
  /// A neighbourhood is measured over its pixels up to this many tolerances from the plane. 1 … 20.
  double near_tolerances = 4.0;
  /// And at least over those up to this far from it. 0 … 10 px.
  double least_near_px = 0.5;
  /// A surface that rises from the plane by more than this share of the plane's own slope per row is an
  /// object's foot. 0 … 2.
  double most_rise_share = 0.5;
  /// A region of which at least this share lies on the plane includes farther pixels. 0 … 1.
  double mostly_share = 0.8;
  /// They lie up to this far off the plane. 0 … 20 px.
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
