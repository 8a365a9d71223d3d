// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/pair_motion.hpp"

#include "palpable/core/numbers/median.hpp"
#include "palpable/vision/rectification/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/calib3d.hpp>

namespace palpable::vision {
namespace {

/// The samples' tolerance over the given one: the focal length may be far off.
constexpr double kLoosened = 2.5;
/// Greatest logarithm of the zoom, and least share of points before the cameras, of an estimate.
constexpr double kMostZoom = 0.2, kLeastBefore = 0.9;

/// The essential matrix with the model's focal lengths; nothing where none is found.
std::optional<MotionModel> sampled(const std::vector<FeatureMatch>& matches, MotionModel at,
                                   double tolerance_px, double confidence) {
  std::vector<cv::Point2d> left, right;
  const double focal = at.focal_px, other = at.zoom * at.focal_px;
  for (const FeatureMatch& m : matches) {
    left.emplace_back((m.left_x - at.cx) / focal, (m.left_y - at.cy) / focal);
    right.emplace_back((m.right_x - at.cx) / other, (m.right_y - at.cy) / other);
  }
  cv::Mat mask;
  const cv::Mat essential = cv::findEssentialMat(left, right, cv::Mat::eye(3, 3, CV_64F), cv::RANSAC,
                                                 confidence, kLoosened * tolerance_px / focal, mask);
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

/// With the direction's sign that puts most points before the cameras.
MotionModel facing(MotionModel at, const std::vector<FeatureMatch>& matches) {
  double sum = 0.0;
  for (const FeatureMatch& m : matches) sum += std::clamp(at.parallax_px(m), -2.0, 2.0);
  if (sum < 0.0) at.direction = -at.direction;
  return at;
}

/// Share of the explained matches before the cameras, of those that moved along their lines by at least the
/// tolerance.
double before_cameras(const MotionModel& at, const std::vector<FeatureMatch>& matches, double tolerance_px) {
  int clear = 0, before = 0;
  for (const FeatureMatch& m : matches) {
    if (std::abs(at.off_line_px(m)) > tolerance_px) continue;
    const double px = at.parallax_px(m);
    if (std::abs(px) < tolerance_px) continue;
    ++clear;
    before += px > 0.0 ? 1 : 0;
  }
  return clear > 0 ? static_cast<double>(before) / clear : 0.0;
}

/// The turn and zoom that explain the matches best without a movement: their distances from it, px.
std::vector<double> off_turn_px(const MotionModel& model, const std::vector<FeatureMatch>& matches,
                                bool known) {
  const auto off = [&](const cv::Vec<double, 5>& by, const FeatureMatch& m) {
    MotionModel at = model;
    cv::Matx33d turn;
    cv::Rodrigues(cv::Vec3d(by[0], by[1], by[2]), turn);
    at.left_from_right = turn * model.left_from_right;
    at.zoom *= std::exp(by[3]);
    at.focal_px *= std::exp(by[4]);
    const cv::Vec3d d = at.right_ray(m) - at.left_ray(m);
    return cv::Vec2d(at.focal_px * d[0], at.focal_px * d[1]);
  };
  const double held = known ? 1e6 : 3.0;
  cv::Vec<double, 5> at = cv::Vec<double, 5>::all(0.0);
  std::vector<double> distances(matches.size(), 0.0);
  // The second time without the farthest third, which may be nearer surfaces.
  double most = 0.0;
  for (int round = 0; round < 3; ++round) {
    const auto residuals = [&](const cv::Vec<double, 5>& by) {
      std::vector<double> out;
      for (std::size_t i = 0; i < matches.size(); ++i) {
        if (distances[i] > most) continue;
        const cv::Vec2d d = off(by, matches[i]);
        out.insert(out.end(), {d[0], d[1]});
      }
      out.insert(out.end(), {(known ? held : 1.0) * by[3], held * by[4]});
      return out;
    };
    at = least_squares<5>(residuals, at);
    for (std::size_t i = 0; i < matches.size(); ++i) distances[i] = cv::norm(off(at, matches[i]));
    std::vector<double> sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    most = sorted[sorted.size() * 2 / 3];
  }
  return distances;
}

/// Estimates from every start, the best of each kind first.
struct MotionCandidates {
  std::vector<MotionModel> models;
  std::vector<double> squares;
  std::size_t best = 0;

  void add(const MotionModel& model, double squares_px) {
    models.push_back(model);
    squares.push_back(squares_px);
  }
};

MotionCandidates candidates_of(const std::vector<FeatureMatch>& matches, const SharedCamera& camera,
                               double tolerance_px, const PairMotionOptions& options) {
  MotionCandidates out;
  const auto settle = [&](const MotionModel& from, MotionUnknowns unknowns) {
    const MotionModel at = facing(settled_model(from, matches, tolerance_px, unknowns), matches);
    if (std::abs(std::log(at.zoom)) <= kMostZoom && before_cameras(at, matches, tolerance_px) >= kLeastBefore)
      out.add(at, truncated_squares(at, matches, tolerance_px, unknowns));
  };
  const double width = 2.0 * camera.cx + 1.0;
  std::vector<double> focals{camera.focal_px};
  if (!camera.known) {
    focals.clear();
    for (const double share : options.focal_shares) focals.push_back(share * width);
  }
  for (const double zoom : camera.known ? std::vector<double>{1.0} : options.zooms)
    for (const double focal : focals) {
      const MotionModel at{cv::Matx33d::eye(), {1, 0, 0}, focal, zoom, camera.cx, camera.cy};
      const auto start = sampled(matches, at, tolerance_px, options.confidence);
      if (!start) continue;
      settle(*start, camera.known  ? MotionUnknowns::pose
                     : zoom == 1.0 ? MotionUnknowns::pose_and_focal
                                   : MotionUnknowns::pose_focal_and_zoom);
    }
  if (out.models.empty()) return out;
  // From the best of them in other directions: forward, sideways and up may explain nearly the same.
  const auto least = [&] {
    return static_cast<std::size_t>(std::min_element(out.squares.begin(), out.squares.end()) -
                                    out.squares.begin());
  };
  const MotionModel from = out.models[least()];
  for (const cv::Vec3d& direction : {cv::Vec3d(1, 0, 0), cv::Vec3d(0, 1, 0), cv::Vec3d(0, 0, 1)}) {
    MotionModel at = from;
    at.direction = direction;
    if (camera.known) {
      settle(at, MotionUnknowns::pose);
      continue;
    }
    settle(at, MotionUnknowns::pose_focal_and_zoom);
    at.zoom = 1.0;
    settle(at, MotionUnknowns::pose_and_focal);
  }
  // The best without a zoom, unless one explains clearly more.
  out.best = least();
  std::size_t plain = out.best;
  double plain_squares = 1e300;
  for (std::size_t i = 0; i < out.models.size(); ++i)
    if (out.models[i].zoom == 1.0 && out.squares[i] < plain_squares) {
      plain = i;
      plain_squares = out.squares[i];
    }
  if (out.squares[out.best] > options.less_by_zoom * plain_squares) out.best = plain;
  return out;
}

/// See PairMotion::certainty.
double certainty_of(const MotionCandidates& candidates, const std::vector<FeatureMatch>& inliers,
                    double deviation_px, bool known, const PairMotionOptions& options) {
  const MotionModel& best = candidates.models[candidates.best];
  const PointDepths depths = depths_of(best, inliers);
  std::vector<MotionModel> others =
      uncertain_models(best, inliers, deviation_px, options.deviations,
                       known              ? MotionUnknowns::pose
                       : best.zoom == 1.0 ? MotionUnknowns::pose_and_focal
                                          : MotionUnknowns::pose_focal_and_zoom);
  for (std::size_t i = 0; i < candidates.models.size(); ++i)
    if (candidates.squares[i] <= options.as_good * candidates.squares[candidates.best])
      others.push_back(candidates.models[i]);
  double least = 1.0;
  for (const MotionModel& other : others)
    least = std::min(least, order_agreement(depths, depths_of(other, inliers).nearness));
  return least;
}

}  // namespace

PointDepths depths_of(const MotionModel& model, const std::vector<FeatureMatch>& matches) {
  PointDepths out;
  for (const FeatureMatch& m : matches) {
    out.nearness.push_back(model.nearness(m));
    out.uncertainty.push_back(kClearParallax_px * model.nearness_per_px(m));
  }
  return out;
}

std::optional<PairMotion> find_pair_motion(const std::vector<FeatureMatch>& matches,
                                           const SharedCamera& camera, double tolerance_px,
                                           const PairMotionOptions& options) {
  if (matches.size() < kLeastMotionMatches) return std::nullopt;
  const MotionCandidates candidates = candidates_of(matches, camera, tolerance_px, options);
  if (candidates.models.empty()) return std::nullopt;
  PairMotion out;
  out.model = candidates.models[candidates.best];
  out.inliers = explained_by(out.model, matches, tolerance_px);
  if (out.inliers.size() < kLeastMotionMatches) return std::nullopt;
  const auto count = static_cast<double>(out.inliers.size());
  double off_squares = 0.0;
  std::vector<double> off;
  for (const FeatureMatch& m : out.inliers) {
    off.push_back(std::abs(out.model.off_line_px(m)));
    off_squares += off.back() * off.back();
  }
  out.residual_px = std::sqrt(off_squares / count);
  const std::vector<double> off_turn = off_turn_px(out.model, out.inliers, camera.known);
  out.parallax_px = std::sqrt(squares_of(off_turn) / count);
  out.beyond_turn = static_cast<double>(std::count_if(off_turn.begin(), off_turn.end(),
                                                      [&](double px) { return px > tolerance_px; })) /
                    count;
  out.certainty =
      certainty_of(candidates, out.inliers, std::max(0.1, 1.48 * median_of(off)), camera.known, options);
  return out;
}

}  // namespace palpable::vision
