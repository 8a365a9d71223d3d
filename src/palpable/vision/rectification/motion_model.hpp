// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/feature_matches.hpp"

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

// Inside vision's sources only: a rigid motion of one camera and what it says of matched points.
namespace palpable::vision {

/// Matches that an estimate needs.
inline constexpr std::size_t kLeastMotionMatches = 20;

/// Which of a camera's numbers are estimated along with its motion.
enum class MotionUnknowns { pose, pose_and_focal, pose_focal_and_zoom };

/// A camera's motion between two pictures: square pixels, one principal point.
struct MotionModel {
  /// Turns rays of the right camera into the left one's axes (x right, y down, z forward).
  cv::Matx33d left_from_right = cv::Matx33d::eye();
  /// Where the right camera is, in the left one's axes: a unit vector.
  cv::Vec3d direction{1, 0, 0};
  double focal_px = 0.0;
  /// The right picture's focal length over the left one's.
  double zoom = 1.0;
  double cx = 0.0, cy = 0.0;

  /// Rays in the left camera's axes with a unit part along its axis.
  cv::Vec3d left_ray(const FeatureMatch& m) const {
    return {(m.left_x - cx) / focal_px, (m.left_y - cy) / focal_px, 1.0};
  }
  cv::Vec3d right_ray(const FeatureMatch& m) const;
  /// Distance of the match from its epipolar lines, px.
  double off_line_px(const FeatureMatch& m) const;
  /// How far the point moved along its line, px: positive in a scene before the cameras.
  double parallax_px(const FeatureMatch& m) const;
  /// Inverse depth along the left camera's axis, for a movement by 1; negative for points that would lie
  /// behind.
  double nearness(const FeatureMatch& m) const;
  /// By how much that changes if the right point moves by 1 px along its line.
  double nearness_per_px(const FeatureMatch& m) const;
};

/// The matches within the tolerance of their epipolar lines.
std::vector<FeatureMatch> explained_by(const MotionModel& model, const std::vector<FeatureMatch>& matches,
                                       double tolerance_px);

/// Truncated squares of the distances from epipolar lines, and those of the priors on the camera, px².
double truncated_squares(const MotionModel& model, const std::vector<FeatureMatch>& matches,
                         double tolerance_px, MotionUnknowns unknowns);

/// Least squares of these distances over `matches` and priors on the camera.
MotionModel refined_model(const MotionModel& from, const std::vector<FeatureMatch>& matches,
                          MotionUnknowns unknowns);

/// Refined in rounds over the matches that it explains, the last within three deviations.
MotionModel settled_model(MotionModel at, const std::vector<FeatureMatch>& matches, double tolerance_px,
                          MotionUnknowns unknowns);

/// The model changed by each of the directions in which `matches` determine it, by so many standard
/// deviations both ways for distances of deviation_px.
std::vector<MotionModel> uncertain_models(const MotionModel& at, const std::vector<FeatureMatch>& matches,
                                          double deviation_px, double deviations, MotionUnknowns unknowns);

}  // namespace palpable::vision
