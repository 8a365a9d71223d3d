// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/motion_model.hpp"

#include "palpable/core/numbers/median.hpp"
#include "palpable/vision/rectification/least_squares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <opencv2/calib3d.hpp>

namespace palpable::vision {
namespace {

/// Priors on the logarithms of the zoom and of the focal length over the usual share of the width, px for a
/// change by 1; what is known is held.
constexpr double kFocalPrior_px = 3.0, kZoomPrior_px = 10.0, kHeld_px = 1e6, kUsualShare = 0.85;
constexpr std::array kRoundTolerances{2.5, 1.5, 1.0, 1.0};
/// Least tolerance of the last rounds, px.
constexpr double kLeastTolerance_px = 0.3;
/// Deviations of a match that still counts in them.
constexpr double kDeviations = 3.0;
/// Rotation, direction, focal length, zoom.
constexpr int kMotionUnknowns = 7;
using MotionStep = cv::Vec<double, kMotionUnknowns>;

/// `from` with a small rotation, a turned direction and other focal lengths.
MotionModel changed(const MotionModel& from, const MotionStep& by) {
  MotionModel out = from;
  cv::Matx33d turn;
  cv::Rodrigues(cv::Vec3d(by[0], by[1], by[2]), turn);
  out.left_from_right = turn * from.left_from_right;
  const cv::Vec3d aside = cv::normalize(
      from.direction.cross(std::abs(from.direction[0]) < 0.7 ? cv::Vec3d(1, 0, 0) : cv::Vec3d(0, 1, 0)));
  out.direction = cv::normalize(from.direction + by[3] * aside + by[4] * from.direction.cross(aside));
  out.focal_px = from.focal_px * std::exp(by[5]);
  out.zoom = from.zoom * std::exp(by[6]);
  return out;
}

MotionStep priors_px(MotionUnknowns unknowns) {
  MotionStep out = MotionStep::all(0.0);
  out[5] = unknowns == MotionUnknowns::pose ? kHeld_px : kFocalPrior_px;
  out[6] = unknowns == MotionUnknowns::pose_focal_and_zoom ? kZoomPrior_px : kHeld_px;
  return out;
}

/// How far the camera is from a usual one, px.
std::array<double, 2> unusual_px(const MotionModel& at, MotionUnknowns unknowns) {
  if (unknowns == MotionUnknowns::pose) return {0.0, 0.0};
  return {kFocalPrior_px * std::log(at.focal_px / (kUsualShare * (2.0 * at.cx + 1.0))),
          kZoomPrior_px * std::log(at.zoom)};
}

}  // namespace

cv::Vec3d MotionModel::right_ray(const FeatureMatch& m) const {
  const double focal = zoom * focal_px;
  const cv::Vec3d ray = left_from_right * cv::Vec3d((m.right_x - cx) / focal, (m.right_y - cy) / focal, 1.0);
  return ray / ray[2];
}

// The first-order distance of both points from where the constraint holds (Sampson 1982), as that of one
// point.
double MotionModel::off_line_px(const FeatureMatch& m) const {
  const double other = zoom * focal_px;
  const cv::Vec3d left = left_ray(m),
                  right =
                      left_from_right * cv::Vec3d((m.right_x - cx) / other, (m.right_y - cy) / other, 1.0),
                  normal = direction.cross(left), by_left = right.cross(direction),
                  by_right = left_from_right.t() * normal;
  const double slope =
      std::hypot(std::hypot(by_left[0], by_left[1]) / focal_px, std::hypot(by_right[0], by_right[1]) / other);
  return std::numbers::sqrt2 * normal.dot(right) / std::max(1e-12, slope);
}

double MotionModel::parallax_px(const FeatureMatch& m) const {
  const cv::Vec3d left = left_ray(m), moved = right_ray(m) - left;
  const double x = direction[2] * left[0] - direction[0], y = direction[2] * left[1] - direction[1];
  return focal_px * (x * moved[0] + y * moved[1]) / std::max(1e-9, std::hypot(x, y));
}

// A point at depth Z on the left ray l lies at l Z; the right camera at t sees it along l Z - t = r (Z -
// t_z), so (l - r) Z = t - t_z r.
double MotionModel::nearness(const FeatureMatch& m) const {
  const cv::Vec3d left = left_ray(m), right = right_ray(m);
  const double x = direction[0] - direction[2] * right[0], y = direction[1] - direction[2] * right[1];
  return ((left[0] - right[0]) * x + (left[1] - right[1]) * y) / std::max(1e-12, x * x + y * y);
}

double MotionModel::nearness_per_px(const FeatureMatch& m) const {
  const cv::Vec3d right = right_ray(m);
  return 1.0 / std::max(1e-12, focal_px * std::hypot(direction[0] - direction[2] * right[0],
                                                     direction[1] - direction[2] * right[1]));
}

std::vector<FeatureMatch> explained_by(const MotionModel& model, const std::vector<FeatureMatch>& matches,
                                       double tolerance_px) {
  std::vector<FeatureMatch> out;
  for (const FeatureMatch& m : matches)
    if (std::abs(model.off_line_px(m)) <= tolerance_px) out.push_back(m);
  return out;
}

double truncated_squares(const MotionModel& model, const std::vector<FeatureMatch>& matches,
                         double tolerance_px, MotionUnknowns unknowns) {
  double sum = 0.0;
  for (const double off : unusual_px(model, unknowns)) sum += off * off;
  for (const FeatureMatch& m : matches) {
    const double off = std::min(std::abs(model.off_line_px(m)), tolerance_px);
    sum += off * off;
  }
  return sum;
}

MotionModel refined_model(const MotionModel& from, const std::vector<FeatureMatch>& matches,
                          MotionUnknowns unknowns) {
  const MotionStep prior_px = priors_px(unknowns);
  const auto residuals = [&](const MotionStep& by) {
    const MotionModel at = changed(from, by);
    std::vector<double> out;
    out.reserve(matches.size() + 4);
    for (const FeatureMatch& m : matches) out.push_back(at.off_line_px(m));
    for (const double off : unusual_px(at, unknowns)) out.push_back(off);
    for (int k = 5; k < kMotionUnknowns; ++k) out.push_back(prior_px[k] == kHeld_px ? kHeld_px * by[k] : 0.0);
    return out;
  };
  return changed(from, least_squares<kMotionUnknowns>(residuals, MotionStep::all(0.0)));
}

MotionModel settled_model(MotionModel at, const std::vector<FeatureMatch>& matches, double tolerance_px,
                          MotionUnknowns unknowns) {
  for (const double loosened : kRoundTolerances) {
    const auto near_lines = explained_by(at, matches, loosened * tolerance_px);
    if (near_lines.size() < kLeastMotionMatches) return at;
    at = refined_model(at, near_lines, unknowns);
  }
  for (int round = 0; round < 2; ++round) {
    std::vector<double> off;
    for (const FeatureMatch& m : explained_by(at, matches, tolerance_px))
      off.push_back(std::abs(at.off_line_px(m)));
    if (off.size() < kLeastMotionMatches) return at;
    // 1.48: the deviation of a normal distribution over its median absolute value.
    const double within = std::clamp(kDeviations * 1.48 * median_of(off), kLeastTolerance_px, tolerance_px);
    const auto near_lines = explained_by(at, matches, within);
    if (near_lines.size() < kLeastMotionMatches) return at;
    at = refined_model(at, near_lines, unknowns);
  }
  return at;
}

std::vector<MotionModel> uncertain_models(const MotionModel& at, const std::vector<FeatureMatch>& matches,
                                          double deviation_px, double deviations, MotionUnknowns unknowns) {
  constexpr double kStep = 1e-6;
  using Square = cv::Matx<double, kMotionUnknowns, kMotionUnknowns>;
  const MotionStep prior_px = priors_px(unknowns);
  Square normal = Square::zeros();
  for (int k = 0; k < kMotionUnknowns; ++k) normal(k, k) = prior_px[k] * prior_px[k];
  std::array<MotionModel, kMotionUnknowns> stepped;
  for (int k = 0; k < kMotionUnknowns; ++k) {
    MotionStep by = MotionStep::all(0.0);
    by[k] = kStep;
    stepped[static_cast<std::size_t>(k)] = changed(at, by);
  }
  for (const FeatureMatch& m : matches) {
    MotionStep row;
    for (int k = 0; k < kMotionUnknowns; ++k)
      row[k] = (stepped[static_cast<std::size_t>(k)].off_line_px(m) - at.off_line_px(m)) / kStep;
    normal += row * row.t();
  }
  cv::Mat values, vectors;
  cv::eigen(cv::Mat(normal), values, vectors);
  std::vector<MotionModel> out;
  for (int k = 0; k < kMotionUnknowns; ++k) {
    const double length = deviations * deviation_px / std::sqrt(std::max(1e-12, values.at<double>(k)));
    for (const double way : {-1.0, 1.0}) {
      MotionStep by;
      for (int i = 0; i < kMotionUnknowns; ++i) by[i] = way * length * vectors.at<double>(k, i);
      // Beyond this the linearisation says nothing.
      const double most = cv::norm(by, cv::NORM_INF);
      if (most > 0.5) by *= 0.5 / most;
      out.push_back(changed(at, by));
    }
  }
  return out;
}

}  // namespace palpable::vision
