// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/reconstruction.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/motion/structure/motion_result.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/calib3d.hpp>

namespace palpable::vision {
namespace {

// Of the robust loss: tracks are not more accurate than this.
constexpr double kLeastRobust_px = 0.05;

template <class T>
auto& at(T& values, int index) {
  return values[static_cast<std::size_t>(index)];
}

}  // namespace

Reconstruction::Reconstruction(std::span<const PointTrack> tracks, std::vector<int> frames,
                               const VideoCamera& camera, const BatchMotionOptions& options)
    : tracks_(tracks),
      frames_(std::move(frames)),
      camera_(camera.pinhole),
      focal_length_known_(camera.focal_length_known),
      options_(options),
      robust_px_(options.robust_px),
      poses_(frames_.size()),
      attempts_(frames_.size(), 0),
      points_(tracks.size()) {}

void Reconstruction::begin(const FirstPair& pair, const Work& work) {
  at(poses_, pair.first) = BundlePose{};
  at(poses_, pair.second) = pair.second_pose;
  triangulate_all();
  refine(20, work);
}

std::vector<std::size_t> Reconstruction::seen_points(int frame) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (points_[i] && tracks_[i].in_frame(frame)) out.push_back(i);
  return out;
}

int Reconstruction::next_keyframe() const {
  int best = -1, most = options_.least_points - 1;
  for (int k = 0; k < static_cast<int>(frames_.size()); ++k) {
    if (at(poses_, k) || refused_.contains(k) || at(attempts_, k) >= options_.most_attempts) continue;
    const int seen = static_cast<int>(seen_points(at(frames_, k)).size());
    if (seen > most) most = seen, best = k;
  }
  return best;
}

const BundlePose* Reconstruction::nearest_pose(int index) const {
  for (int step = 1; step < static_cast<int>(frames_.size()); ++step)
    for (const int other : {index - step, index + step})
      if (other >= 0 && other < static_cast<int>(frames_.size()) && at(poses_, other))
        return &*at(poses_, other);
  return nullptr;
}

bool Reconstruction::add_keyframe(int index) {
  ++at(attempts_, index);
  const auto pose = pose_from_points(at(frames_, index), nearest_pose(index));
  if (!pose) {
    refused_.insert(index);
    return false;
  }
  at(poses_, index) = pose;
  refused_.clear();
  return true;
}

std::optional<BundlePose> Reconstruction::pose_from_points(int frame, const BundlePose* guess) const {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> places;
  for (const std::size_t i : seen_points(frame)) {
    points.emplace_back((*points_[i])[0], (*points_[i])[1], (*points_[i])[2]);
    places.emplace_back(tracks_[i].in(frame).x, tracks_[i].in(frame).y);
  }
  if (static_cast<int>(points.size()) < options_.least_points) return std::nullopt;
  const cv::Matx33d k(camera_.fx, 0, camera_.cx, 0, camera_.fy, camera_.cy, 0, 0, 1);
  const auto posed = [&](bool by_guess) -> std::optional<BundlePose> {
    cv::Mat rotation, translation, inliers;
    if (by_guess) {
      rotation = (cv::Mat_<double>(3, 1) << (*guess)[0], (*guess)[1], (*guess)[2]);
      translation = (cv::Mat_<double>(3, 1) << (*guess)[3], (*guess)[4], (*guess)[5]);
    }
    const bool found = cv::solvePnPRansac(points, places, k, cv::noArray(), rotation, translation, by_guess,
                                          200, static_cast<float>(2 * options_.outlier_px), 0.999, inliers);
    if (!found || inliers.rows < options_.least_points || 2 * inliers.rows < static_cast<int>(points.size()))
      return std::nullopt;
    BundlePose out{};
    for (int i = 0; i < 3; ++i)
      at(out, i) = rotation.at<double>(i), at(out, 3 + i) = translation.at<double>(i);
    return out;
  };
  // A neighbour's pose is no guess where pictures were taken far apart.
  auto out = guess != nullptr ? posed(true) : std::nullopt;
  return out ? out : posed(false);
}

void Reconstruction::drop_unsupported_poses() {
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    if (!poses_[k]) continue;
    const std::vector<std::size_t> seen = seen_points(frames_[k]);
    const auto good = std::count_if(seen.begin(), seen.end(), [&](std::size_t i) {
      return projection_error_px(camera_, *poses_[k], *points_[i], tracks_[i].in(frames_[k])) <=
             options_.outlier_px;
    });
    if (good < options_.least_points) poses_[k] = std::nullopt;
  }
}

std::vector<PosedObservation> Reconstruction::observations_of(std::size_t track) const {
  std::vector<PosedObservation> out;
  for (int k = 0; k < static_cast<int>(frames_.size()); ++k)
    if (at(poses_, k) && tracks_[track].in_frame(at(frames_, k)))
      out.push_back({*at(poses_, k), tracks_[track].in(at(frames_, k))});
  return out;
}

void Reconstruction::triangulate_all() {
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (!points_[i])
      points_[i] =
          triangulated_point(observations_of(i), camera_, {options_.least_angle_deg, options_.outlier_px});
}

Reconstruction::Parts Reconstruction::parts() const {
  Parts out;
  auto& [bundle, pose_index, point_tracks] = out;
  pose_index.assign(frames_.size(), -1);
  for (std::size_t k = 0; k < frames_.size(); ++k)
    if (poses_[k]) pose_index[k] = static_cast<int>(bundle.poses.size()), bundle.poses.push_back(*poses_[k]);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!points_[i]) continue;
    for (std::size_t k = 0; k < frames_.size(); ++k)
      if (poses_[k] && tracks_[i].in_frame(frames_[k]))
        bundle.observations.push_back(
            {pose_index[k], static_cast<int>(bundle.points.size()), tracks_[i].in(frames_[k])});
    bundle.points.push_back(*points_[i]);
    point_tracks.push_back(i);
  }
  return out;
}

void Reconstruction::find_readout(std::span<const int> frame_numbers, int iterations, const Work& work) {
  Parts known = parts();
  for (std::size_t k = 0; k < frames_.size(); ++k)
    for (Observation& o : known.bundle.observations)
      if (o.pose == known.pose_index[k])
        o.motion = place_motion(tracks_[at(known.point_tracks, o.point)], frames_[k], frame_numbers);
  const BundleCosts costs =
      adjust_bundle(known.bundle, camera_,
                    {.robust_px = robust_px_, .most_iterations = iterations, .refine_readout = true}, work);
  if (costs.after > (1 - options_.least_readout_gain) * costs.before) return;
  const Readout found = known.bundle.readout;
  if (std::max(std::abs(found.rows), std::abs(found.columns)) > 1) return;
  // A sensor is read along one of its sides.
  readout_ =
      std::abs(found.rows) >= std::abs(found.columns) ? Readout{found.rows, 0} : Readout{0, found.columns};
  own_tracks_ = without_rolling_shutter(tracks_, readout_, camera_.width, camera_.height, frame_numbers);
  tracks_ = own_tracks_;
  refine(iterations, work);
}

void Reconstruction::refine(int iterations, const Work& work) {
  auto [bundle, pose_index, point_tracks] = parts();
  const bool refine_focal =
      !focal_length_known_ && std::ssize(bundle.poses) >= options_.views_for_focal_length;
  adjust_bundle(bundle, camera_,
                {.robust_px = robust_px_, .most_iterations = iterations, .refine_focal_length = refine_focal},
                work);
  camera_.fx *= bundle.focal_scale, camera_.fy *= bundle.focal_scale;
  for (std::size_t k = 0; k < frames_.size(); ++k)
    if (poses_[k]) poses_[k] = at(bundle.poses, pose_index[k]);
  std::vector<double> errors, worst(bundle.points.size(), 0.0);
  for (const Observation& s : bundle.observations) {
    errors.push_back(
        projection_error_px(camera_, at(bundle.poses, s.pose), at(bundle.points, s.point), s.place));
    at(worst, s.point) = std::max(at(worst, s.point), errors.back());
  }
  if (!errors.empty()) robust_px_ = std::clamp(quantile_of(errors, 0.5), kLeastRobust_px, options_.robust_px);
  for (std::size_t p = 0; p < point_tracks.size(); ++p) {
    auto& point = points_[point_tracks[p]];
    point = worst[p] <= options_.outlier_px ? std::optional(bundle.points[p]) : std::nullopt;
  }
  drop_unsupported_poses();
}

void Reconstruction::add_all_frames(int frame_count, const Work& work) {
  std::vector<int> all(static_cast<std::size_t>(frame_count));
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::optional<BundlePose>> poses(all.size());
  for (std::size_t k = 0; k < frames_.size(); ++k) at(poses, frames_[k]) = poses_[k];
  for (int frame = 0; frame < frame_count && !work.cancelled(); ++frame) {
    const auto* before = frame > 0 && at(poses, frame - 1) ? &*at(poses, frame - 1) : nullptr;
    if (!at(poses, frame)) at(poses, frame) = pose_from_points(frame, before);
  }
  frames_ = std::move(all);
  poses_ = std::move(poses);
  attempts_.assign(frames_.size(), 0);
}

CameraMotion Reconstruction::result() const {
  CameraMotion out = motion_result({camera_, frames_, poses_, points_}, tracks_);
  out.readout = readout_;
  return out;
}

}  // namespace palpable::vision
