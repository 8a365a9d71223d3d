// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/feature_matches.hpp"

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

// Inside vision's sources only: how two pictures' cameras are turned to each other, found from features.
namespace palpable::vision {

/// The camera that both pictures are thought to come from.
struct Eye {
  double focal_px = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  /// False: the focal length is sought along with the turns, from focal_px on, and the lens may bend straight
  /// lines.
  bool known = false;
};

/// An unknown camera: the picture's middle, and a focal length that is only where the search begins.
Eye unknown_eye(int width, int height);

/// What brings both pictures to common scanlines.
struct Straightening {
  cv::Matx33d left = cv::Matx33d::eye();
  cv::Matx33d right = cv::Matx33d::eye();
  /// Both lenses' distortion by the division model, about (cx, cy): u = p / (1 + bend |p|²), 1/px².
  double bend = 0.0;
  double cx = 0.0;
  double cy = 0.0;
};

/// The place in the straightened picture; and back, where there is such a place in the picture.
cv::Point2d straightened(const Straightening& by, const cv::Matx33d& homography, cv::Point2d place);
cv::Point2d bent_back(const Straightening& by, const cv::Matx33d& inverse_homography, cv::Point2d place);

struct TurnedCameras {
  Straightening how;
  /// Those of the matches that agree on it, as they were.
  std::vector<FeatureMatch> matches;
};

/// Turns both cameras so that matches share scanlines (Fusiello & Irsara 2011: the left one about y and z,
/// the right one about x, y and z, one focal length where it is unknown), the left one as little as possible.
/// The turns are a fundamental matrix's parameters, found by random samples of five matches and refined over
/// all that lie within `tolerance_px`. Fewer than 8 that agree: `matches` is empty. Deterministic for a seed.
TurnedCameras turns_to_scanlines(const std::vector<FeatureMatch>& matches, const Eye& eye,
                                 double tolerance_px, std::uint64_t seed);

/// The simplest of explanations, and only roughly: the right picture moved up or down and turned in its
/// plane, so that most matches come within a few pixels of common scanlines.
TurnedCameras rough_turns(const std::vector<FeatureMatch>& matches, const Eye& eye, double tolerance_px,
                          std::uint64_t seed);

/// Those that share scanlines once straightened, within `tolerance_px`. Matches of one place of the left
/// picture that stand beside each other are alternatives: the one that comes nearest to its row counts.
std::vector<FeatureMatch> within(const std::vector<FeatureMatch>& matches, const Straightening& by,
                                 double tolerance_px);

/// Of alternatives, the one that comes nearest to its row.
std::vector<FeatureMatch> one_a_place(const std::vector<FeatureMatch>& matches, const Straightening& by);

/// The matches as the straightening moves them.
std::vector<FeatureMatch> moved(const std::vector<FeatureMatch>& matches, const Straightening& by);

/// RMS distance, in pixels, of the matches from where the best turn of the right camera alone would put them:
/// what is left is parallax. NaN without matches.
double parallax_rms_px(const std::vector<FeatureMatch>& matches, const Eye& eye);

}  // namespace palpable::vision
