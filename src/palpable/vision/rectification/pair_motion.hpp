// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/vision/rectification/feature_matches.hpp"
#include "palpable/vision/stereo/problem/rectifying_transform.hpp"

#include <optional>
#include <vector>

// Inside vision's sources only: how one camera moved between two pictures, in any direction.
namespace palpable::vision {

/// A rigid motion in a scene that does not move.
struct PairMotion {
  /// Turns rays of the right camera into the left one's axes (x right, y down, z forward).
  Matrix3 left_from_right = kIdentity3;
  /// Where the right camera is, in the left one's axes: a unit vector.
  Vec3 direction;
  double focal_px = 0.0;
  /// The right picture's focal length over the left one's.
  double zoom = 1.0;
  /// The matches that the motion explains.
  std::vector<FeatureMatch> inliers;
  /// RMS distance of the inliers from their epipolar lines, px.
  double residual_px = 0.0;
  /// What the rotation alone does not explain: RMS, px.
  double parallax_px = 0.0;
  /// Share of the inliers whose parallax has the direction's sign, of those that have at least the tolerance.
  double same_sign = 0.0;
};

struct PairMotionOptions {
  /// Focal lengths that are tried, as shares of the picture's width, and the right picture's over the left
  /// one's.
  std::vector<double> focal_shares{0.65, 1.05};
  std::vector<double> zooms{1.0, 0.93, 1.075};
  /// A zoom counts if it explains this many times the matches that none explains.
  double more_by_zoom = 1.05;
  /// Confidence of the random samples, 0 … 1.
  double confidence = 0.999;
  /// Tolerances of the rounds of least squares, times the tolerance.
  std::vector<double> round_tolerances{2.5, 1.5, 1.0, 1.0};
};

/// By the essential matrix (five points; Nistér 2004) with several focal lengths, then by least squares of
/// the distances to the epipolar lines over rotation, direction and focal lengths; square pixels, principal
/// point in the middle. Nothing without enough matches. Deterministic.
std::optional<PairMotion> find_pair_motion(const std::vector<FeatureMatch>& matches, int width, int height,
                                           double tolerance_px, const PairMotionOptions& options = {});

}  // namespace palpable::vision
