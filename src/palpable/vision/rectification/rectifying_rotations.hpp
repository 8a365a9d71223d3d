// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/feature_matches.hpp"
#include "palpable/vision/rectification/lens_camera.hpp"

#include <cstdint>
#include <vector>

// Inside vision's sources only: the rotations of two cameras that rectify their pictures, estimated from
// matches.
namespace palpable::vision {

/// The assumed common intrinsics of both pictures.
struct SharedCamera {
  double focal_px = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  /// False: the focal length is estimated along with the rotations, starting at focal_px, and so is the
  /// lens's distortion.
  bool known = false;
};

/// An unknown camera: the principal point in the picture's centre, and an initial value for the focal length.
SharedCamera unknown_camera(int width, int height);

struct RectifyingRotations {
  RectifyingTransform transform;
  /// The inlier matches, in the original pictures.
  std::vector<FeatureMatch> inliers;
};

/// Rotates both cameras so that matches share rows, the left camera as little as possible (Fusiello & Irsara
/// 2011: the left one about y and z, the right one about x, y and z, and one focal length if it is unknown).
/// The rotations parametrise a fundamental matrix, which is estimated by RANSAC and refined over all matches
/// within `tolerance_px`. Without a solution `inliers` is empty. Deterministic for a seed.
RectifyingRotations find_rectifying_rotations(const std::vector<FeatureMatch>& matches,
                                              const SharedCamera& camera, double tolerance_px,
                                              std::uint64_t seed, const RotationSearchOptions& options = {});

/// A rough estimate with the simplest model: the right picture is shifted vertically and rotated in its
/// plane, so that most matches are within a few pixels of common rows.
RectifyingRotations find_rough_rotations(const std::vector<FeatureMatch>& matches, const SharedCamera& camera,
                                         double tolerance_px, std::uint64_t seed,
                                         const RotationSearchOptions& options = {});

/// The matches that share rows within `tolerance_px` after rectification. Consecutive matches of one left
/// point are alternatives: the one nearest to its row counts.
std::vector<FeatureMatch> inliers_of(const std::vector<FeatureMatch>& matches, const RectifyingTransform& by,
                                     double tolerance_px);

/// Of alternatives, the one nearest to its row.
std::vector<FeatureMatch> best_alternatives(const std::vector<FeatureMatch>& matches,
                                            const RectifyingTransform& by);

/// The matches in the rectified pictures.
std::vector<FeatureMatch> rectified_matches(const std::vector<FeatureMatch>& matches,
                                            const RectifyingTransform& by);

/// RMS parallax in pixels: what the best rotation of the right camera alone does not explain. NaN without
/// matches.
double parallax_rms_px(const std::vector<FeatureMatch>& matches, const SharedCamera& camera);

}  // namespace palpable::vision
