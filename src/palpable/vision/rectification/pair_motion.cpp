// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/pair_motion.hpp"

#include "palpable/vision/rectification/least_squares.hpp"

#include <cmath>

#include <opencv2/calib3d.hpp>

namespace palpable::vision {
namespace {

constexpr std::size_t kLeastMatches = 20;
/// Weights of the priors on the logarithms of the focal length and of the zoom, px; a zoom of 1 is held.
constexpr double kFocalPrior_px = 3.0, kZoomPrior_px = 30.0, kHeld_px = 1e6;
/// Rotation, direction, focal length, zoom.
constexpr int kUnknowns = 7;
using Unknowns = cv::Vec<double, kUnknowns>;

/// A motion and its camera, without what follows from the matches.
struct Estimate {
  cv::Matx33d left_from_right;
  cv::Vec3d direction;
  double focal_px;
  double zoom;
  double cx, cy;

  cv::Vec3d left_ray(const FeatureMatch& m) const {
    return {(m.left_x - cx) / focal_px, (m.left_y - cy) / focal_px, 1.0};
  }
  /// In the left camera's axes.
  cv::Vec3d right_ray(const FeatureMatch& m) const {
    const double focal = zoom * focal_px;
    const cv::Vec3d ray =
        left_from_right * cv::Vec3d((m.right_x - cx) / focal, (m.right_y - cy) / focal, 1.0);
    return ray / ray[2];
  }
  /// Distance of the turned right point from the left point's epipolar line, px.
  double off_line_px(const FeatureMatch& m) const {
    const cv::Vec3d normal = direction.cross(left_ray(m));
    return focal_px * normal.dot(right_ray(m)) / std::max(1e-9, std::hypot(normal[0], normal[1]));
  }
  /// How far the point moved along its line, px: positive in a scene before the cameras.
  double parallax_px(const FeatureMatch& m) const {
    const cv::Vec3d left = left_ray(m), moved = right_ray(m) - left;
    const double x = direction[2] * left[0] - direction[0], y = direction[2] * left[1] - direction[1];
    return focal_px * (x * moved[0] + y * moved[1]) / std::max(1e-9, std::hypot(x, y));
  }
};

std::vector<FeatureMatch> inliers_of(const Estimate& at, const std::vector<FeatureMatch>& matches,
                                     double tolerance_px) {
  std::vector<FeatureMatch> out;
  for (const FeatureMatch& m : matches)
    if (std::abs(at.off_line_px(m)) <= tolerance_px) out.push_back(m);
  return out;
}

/// The essential matrix with these focal lengths; nothing where none is found.
std::optional<Estimate> estimate(const std::vector<FeatureMatch>& matches, Estimate at, double tolerance_px,
                                 double confidence) {
  std::vector<cv::Point2d> left, right;
  const double focal = at.focal_px, other = at.zoom * at.focal_px;
  for (const FeatureMatch& m : matches) {
    left.emplace_back((m.left_x - at.cx) / focal, (m.left_y - at.cy) / focal);
    right.emplace_back((m.right_x - at.cx) / other, (m.right_y - at.cy) / other);
  }
  cv::Mat mask;
  const cv::Mat essential = cv::findEssentialMat(left, right, cv::Mat::eye(3, 3, CV_64F), cv::RANSAC,
                                                 confidence, tolerance_px / focal, mask);
  if (essential.rows != 3 || essential.cols != 3) return std::nullopt;
  cv::Mat turn, shift;
  cv::recoverPose(essential, left, right, turn, shift, 1.0, {0.0, 0.0}, mask);
  const cv::Matx33d rotation(turn.ptr<double>());
  const cv::Vec3d translation(shift.ptr<double>());
  // p_right = rotation p_left + translation.
  at.left_from_right = rotation.t();
  at.direction = -(rotation.t() * translation);
  return at;
}

/// `from` with a small rotation, a turned direction and another focal length.
Estimate changed(const Estimate& from, const Unknowns& by) {
  Estimate out = from;
  cv::Matx33d turn;
  cv::Rodrigues(cv::Vec3d(by[0], by[1], by[2]), turn);
  out.left_from_right = turn * from.left_from_right;
  const cv::Vec3d aside = cv::normalize(
      from.direction.cross(std::abs(from.direction[0]) < 0.7 ? cv::Vec3d(1, 0, 0) : cv::Vec3d(0, 1, 0)));
  out.direction = cv::normalize(from.direction + by[3] * aside + by[4] * from.direction.cross(aside));
  out.focal_px = from.focal_px * std::exp(by[5]);
  if (from.zoom != 1.0) out.zoom = from.zoom * std::exp(by[6]);
  return out;
}

Estimate refined(const Estimate& from, const std::vector<FeatureMatch>& matches) {
  const auto residuals = [&](const Unknowns& by) {
    const Estimate at = changed(from, by);
    std::vector<double> out;
    out.reserve(matches.size() + 2);
    for (const FeatureMatch& m : matches) out.push_back(at.off_line_px(m));
    out.push_back(kFocalPrior_px * by[5]);
    out.push_back(from.zoom == 1.0 ? kHeld_px * by[6] : kZoomPrior_px * std::log(at.zoom));
    return out;
  };
  return changed(from, least_squares<kUnknowns>(residuals, Unknowns::all(0.0)));
}

PairMotion motion_of(const Estimate& at, std::vector<FeatureMatch> inliers, double tolerance_px) {
  PairMotion out;
  std::copy_n(at.left_from_right.val, out.left_from_right.size(), out.left_from_right.begin());
  out.direction = {at.direction[0], at.direction[1], at.direction[2]};
  out.focal_px = at.focal_px;
  out.zoom = at.zoom;
  double squares = 0.0, off_squares = 0.0;
  int clear = 0, same = 0;
  for (const FeatureMatch& m : inliers) {
    off_squares += at.off_line_px(m) * at.off_line_px(m);
    const double px = at.parallax_px(m);
    squares += px * px;
    if (std::abs(px) < tolerance_px) continue;
    ++clear;
    same += px > 0.0 ? 1 : 0;
  }
  out.parallax_px = std::sqrt(squares / static_cast<double>(inliers.size()));
  out.residual_px = std::sqrt(off_squares / static_cast<double>(inliers.size()));
  out.same_sign = clear > 0 ? static_cast<double>(same) / clear : 0.0;
  out.inliers = std::move(inliers);
  return out;
}

/// Refined over the matches that it explains.
Estimate settled(Estimate at, const std::vector<FeatureMatch>& matches, double tolerance_px,
                 const PairMotionOptions& options) {
  for (const double loosened : options.round_tolerances) {
    const std::vector<FeatureMatch> inliers = inliers_of(at, matches, loosened * tolerance_px);
    if (inliers.size() < kLeastMatches) break;
    at = refined(at, inliers);
  }
  return at;
}

}  // namespace

std::optional<PairMotion> find_pair_motion(const std::vector<FeatureMatch>& matches, int width, int height,
                                           double tolerance_px, const PairMotionOptions& options) {
  if (matches.size() < kLeastMatches) return std::nullopt;
  std::optional<Estimate> best;
  double most = 0.0;
  for (const double zoom : options.zooms)
    for (const double share : options.focal_shares) {
      const Estimate camera{{}, {}, share * width, zoom, 0.5 * (width - 1), 0.5 * (height - 1)};
      auto at =
          estimate(matches, camera, options.round_tolerances.front() * tolerance_px, options.confidence);
      if (!at) continue;
      at = settled(*at, matches, tolerance_px, options);
      const auto explained = static_cast<double>(inliers_of(*at, matches, tolerance_px).size());
      if (explained <= most * (zoom != 1.0 && best && best->zoom == 1.0 ? options.more_by_zoom : 1.0))
        continue;
      best = at;
      most = explained;
    }
  if (!best || most < static_cast<double>(kLeastMatches)) return std::nullopt;
  return motion_of(*best, inliers_of(*best, matches, tolerance_px), tolerance_px);
}

}  // namespace palpable::vision
