// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/depth_order.hpp"
#include "palpable/vision/rectification/motion_model.hpp"
#include "palpable/vision/rectification/rectifying_rotations.hpp"

#include <optional>
#include <vector>

// Inside vision's sources only: how one camera moved between two pictures, in any direction.
namespace palpable::vision {

/// A rigid motion in a scene that does not move.
struct PairMotion {
  MotionModel model;
  /// The matches that the motion explains.
  std::vector<FeatureMatch> inliers;
  /// RMS distance of the inliers from their epipolar lines, px.
  double residual_px = 0.0;
  /// What a camera that only turned and zoomed does not explain of the inliers: RMS, px, and the share of
  /// inliers that are farther from it than the tolerance.
  double parallax_px = 0.0;
  double beyond_turn = 0.0;
  /// The least order_agreement() of the inliers' inverse depths with what they are by another motion that
  /// explains the matches about as well: near 1 if the matches determine which is nearer, -1 if near and far
  /// may be exchanged.
  double certainty = 0.0;
};

/// The inverse depths of the inliers; they differ clearly by more than this, px.
inline constexpr double kClearParallax_px = 1.5;
PointDepths depths_of(const MotionModel& model, const std::vector<FeatureMatch>& matches);

struct PairMotionOptions {
  /// Focal lengths that are tried, as shares of the picture's width, and the right picture's over the left
  /// one's.
  std::vector<double> focal_shares{0.65, 1.05};
  std::vector<double> zooms{1.0, 0.93, 1.075};
  /// A zoom counts if it leaves at most this share of the squared distances that none leaves.
  double less_by_zoom = 0.95;
  /// Another motion explains the matches about as well if it leaves at most this many times the squares.
  double as_good = 1.1;
  /// Standard deviations by which the estimate is varied.
  double deviations = 6.0;
  /// Confidence of the random samples, 0 … 1.
  double confidence = 0.999;
};

/// By the essential matrix (five points; Nistér 2004) with several focal lengths, then by least squares of
/// the distances to the epipolar lines over rotation, direction and, unless the camera is known, focal length
/// and zoom; square pixels. Nothing without enough matches. Deterministic.
std::optional<PairMotion> find_pair_motion(const std::vector<FeatureMatch>& matches,
                                           const SharedCamera& camera, double tolerance_px,
                                           const PairMotionOptions& options = {});

}  // namespace palpable::vision
