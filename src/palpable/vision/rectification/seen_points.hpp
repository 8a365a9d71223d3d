// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/feature_matches.hpp"

#include <random>
#include <vector>

#include <opencv2/calib3d.hpp>

// For tests: points of a scene in both pictures of a moved camera, without pictures.
namespace palpable::vision {

inline constexpr int kSeenWidth = 480, kSeenHeight = 360;
inline constexpr double kSeenFocal_px = 400.0;

struct SeenPoint {
  FeatureMatch match;
  /// Along the left camera's axis.
  double depth_m;
};

/// Points from nearest_m to farthest_m away with errors of 0.2 px, seen before and after the camera moved by
/// `move_m`, turned by `turn_deg` and zoomed.
inline std::vector<SeenPoint> seen_points(cv::Vec3d move_m, cv::Vec3d turn_deg, double zoom = 1.0,
                                          double nearest_m = 1.5, double farthest_m = 4.0) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(0.0, kSeenWidth - 1.0), down(0.0, kSeenHeight - 1.0),
      depth(nearest_m, farthest_m);
  std::normal_distribution<double> error(0.0, 0.2);
  const double cx = 0.5 * (kSeenWidth - 1), cy = 0.5 * (kSeenHeight - 1);
  cv::Matx33d left_from_right;
  cv::Rodrigues(turn_deg * (CV_PI / 180.0), left_from_right);
  std::vector<SeenPoint> out;
  for (int i = 0; i < 300; ++i) {
    const double x = across(random), y = down(random), z = depth(random);
    const cv::Vec3d point((x - cx) / kSeenFocal_px * z, (y - cy) / kSeenFocal_px * z, z);
    const cv::Vec3d p = left_from_right.t() * (point - move_m);
    const double u = cx + zoom * kSeenFocal_px * p[0] / p[2], v = cy + zoom * kSeenFocal_px * p[1] / p[2];
    out.push_back({{x, y, u + error(random), v + error(random)}, z});
  }
  return out;
}

inline std::vector<FeatureMatch> matches_of(const std::vector<SeenPoint>& points) {
  std::vector<FeatureMatch> out;
  for (const SeenPoint& p : points) out.push_back(p.match);
  return out;
}

}  // namespace palpable::vision
