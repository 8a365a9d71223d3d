// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"

#include <array>
#include <vector>

// Parameters of the rectification of pairs from unknown cameras. Defaults were chosen on chessboard pairs
// (scored by corners that nothing was fitted to), on phone photographs and on rolling offsets added to
// Middlebury pairs (docs/rectification.md).
namespace palpable::vision {

/// How features are found and matched (SIFT).
struct FeatureMatchOptions {
  /// Features are detected in copies at most this long, px. 200 … 10000.
  int longest_px = 1600;
  /// Most features of a picture. 50 … 100000.
  int most_features = 2000;
  /// A match's descriptor distance over the second best (Lowe's ratio). 0.1 … 1.
  double ratio = 0.8;
  /// A picture that uses less than this share of its range is stretched, by at most this gain: the detector's
  /// contrast threshold is fixed. 0 … 1; 1 … 64.
  double few_levels = 0.4;
  double most_gain = 8.0;
  /// Greatest distance of a match from its row, px of the copy. 0.1 … 20.
  double tolerance_px = 1.5;
};

/// How corners are tracked from one roughly rectified picture to the other, to add matches in repeated
/// patterns.
struct CornerTrackingOptions {
  /// Corners are tracked in copies at most this long, px. 100 … 10000.
  int longest_px = 800;
  /// Corner detection (Shi & Tomasi): most corners, quality over the best one's; they are at least spacing_px
  /// apart, and no more than corners_across fit beside each other. 10 … 100000; 0.0001 … 1; 1 … 100 px;
  /// 2 … 10000.
  int most_corners = 800;
  double corner_quality = 0.01;
  double spacing_px = 4.0;
  double corners_across = 80.0;
  /// Lucas & Kanade: window, px, and pyramid levels. 3 … 63; 0 … 6.
  int window_px = 15;
  int pyramid_levels = 2;
  /// The disparity that predicts corners is computed in copies at most this long, px (100 … 2000), over the
  /// known disparities without this share at either end (0 … 0.4), widened by their span and these margins:
  /// shares of the span and of the width (0 … 1), px (0 … 50).
  int disparity_longest_px = 400;
  double outer_share = 0.05;
  double margin_far_share = 0.25;
  double margin_near_share = 0.12;
  double margin_px = 4.0;
  /// Repeated patterns: points of similar appearance on about the same row are tracked too. Half the template
  /// and half the band of rows, px (2 … 50); most alternatives (0 … 20); reach, share of the width (0 … 1);
  /// least correlation, and least share of the best one (0 … 1).
  int template_half_px = 9;
  int band_half_px = 4;
  int most_alternatives = 4;
  double reach_share = 0.2;
  double least_correlation = 0.75;
  double least_of_best = 0.85;
  /// A track counts if tracking back ends within round_trip_px of its start and it ends within most_drift_px
  /// of its prediction; alternatives are at least apart_px apart. 0.01 … 100 px each.
  double round_trip_px = 0.3;
  double most_drift_px = 12.0;
  double apart_px = 8.0;
};

/// Estimation of the rectifying rotations (rectifying_rotations.hpp).
struct RotationSearchOptions {
  /// Random samples of matches, and how many of the best are refined. 10 … 100000; 1 … 100.
  int trials = 1000;
  int refined_starts = 6;
  /// Matches that a sample is scored on. 10 … 100000.
  int scored_matches = 400;
  /// Samples whose rotations are greater are rejected, radians. 0.01 … 1.5.
  double most_rotation = 0.35;
  /// Least number of inliers of a solution. 8 … 1000.
  int least_matches = 8;
  /// Inlier tolerances of the refinement rounds, times the feature tolerance. Each 1 … 10.
  std::array<double, 4> round_tolerances{2.5, 1.5, 1.0, 1.0};
  /// Weights of the prior "no rotation, usual focal length, no distortion", px for an unknown of 1: left
  /// about y and z, right about x, y and z (radians), logarithm of the focal length, distortion. The prior is
  /// stronger for the left picture, which is the reference, and about the vertical axis, which moves objects
  /// out of the picture. Each 0.001 … 1e6.
  std::array<double, 7> prior_px{100.0, 30.0, 3.0, 30.0, 3.0, 3.0, 3.0};
  /// A simpler model is used if it has at least this share of the inliers (0 … 1), and its residual is at
  /// most this multiple of the richer one's (1 … 10) or below this share of the tolerance (0 … 1).
  double simple_matches_share = 0.95;
  double simple_residual_ratio = 1.05;
  double simple_residual_share = 0.2;
  /// Matches that a distortion estimate needs. 8 … 100000.
  int least_for_distortion = 60;
  /// Tolerance of a rough estimate, times the feature tolerance. 1 … 20.
  double rough_tolerance = 4.0;
};

/// A smooth surface of vertical offsets (vertical_offsets.hpp).
struct VerticalOffsetOptions {
  /// Control values of the B-spline across and down the picture. 4 … 64 each.
  int controls_across = 8;
  int controls_down = 13;
  /// Matches that a surface needs. 4 … 100000.
  int least_matches = 100;
  /// Weight of smoothness (squared second differences of the control values). 0 … 100.
  double smoothness = 0.03;
  /// Scale of the robust weights: from first to last, times the factor each round. 0.01 … 100 px; 0.1 … 0.99.
  double first_scale_px = 6.0;
  double last_scale_px = 0.5;
  double scale_factor = 0.8;
  /// The surface is used if it has more_matches times as many inliers as the rotations, or as many with
  /// less_residual times their residual while that is above good_residual_px; and only for offsets above
  /// least_offset_px. 1 … 10; 0 … 1; 0 … 10 px; 0 … 100 px.
  double more_matches = 1.08;
  double less_residual = 0.85;
  double good_residual_px = 0.3;
  double least_offset_px = 1.0;
};

struct StereoRectificationOptions {
  /// A pair counts as rectified, and is not changed, if its matches are at most rectified_px (RMS) off common
  /// rows and at least rectified_matches_share as many as a rotation's inliers. 0 … 10 px; 0.1 … 1.
  double rectified_px = 0.5;
  double rectified_matches_share = 0.9;
  /// A pair is returned unchanged if the residual (RMS) would be larger, or there are fewer inliers. 0.1 …
  /// 100 px; 8 … 1000.
  double most_residual_px = 2.0;
  int least_matches = 20;
  /// Rounds of corner tracking and estimation, ended early where rectified_matches_share of the corners lie
  /// on common rows. 1 … 10.
  int rounds = 2;
  /// If at most this share of the corners is on common rows, estimation restarts from a rough estimate. 0 …
  /// 1.
  double restart_share = 0.6;
  /// If the parallax (RMS) is less than this, a note says that the camera hardly moved. 0 … 100 px.
  double least_parallax_px = 1.0;
  FeatureMatchOptions features;
  CornerTrackingOptions tracking;
  RotationSearchOptions rotations;
  VerticalOffsetOptions offsets;
};
std::vector<Parameter> parameters_of(StereoRectificationOptions& options);

}  // namespace palpable::vision
