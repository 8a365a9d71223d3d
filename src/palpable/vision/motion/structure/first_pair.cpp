// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/first_pair.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/motion/structure/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Dense>
#include <ceres/rotation.h>
#include <opencv2/calib3d.hpp>

namespace palpable::vision {
namespace {

struct CommonPlaces {
  std::vector<cv::Point2d> first, second;
};

CommonPlaces common_places(std::span<const PointTrack> tracks, int a, int b) {
  CommonPlaces out;
  for (const PointTrack& track : tracks) {
    if (!track.in_frame(a) || !track.in_frame(b)) continue;
    out.first.emplace_back(track.in(a).x, track.in(a).y);
    out.second.emplace_back(track.in(b).x, track.in(b).y);
  }
  return out;
}

BundlePose pose_of(const cv::Mat& rotation, const cv::Mat& translation) {
  BundlePose out{};
  const cv::Matx33d r(rotation.ptr<double>());
  ceres::RotationMatrixToAngleAxis(ceres::RowMajorAdapter3x3(r.val), out.data());
  for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(3 + i)] = translation.at<double>(i);
  return out;
}

Eigen::Vector3d direction(const Pinhole& camera, const cv::Point2d& place) {
  return Eigen::Vector3d((place.x - camera.cx) / camera.fx, (place.y - camera.cy) / camera.fy, 1)
      .normalized();
}

// Median parallax, px: the movement of points after the camera's rotation that explains most of it (Kabsch
// 1976) is removed. Without parallax depth cannot be determined.
double parallax_px(const CommonPlaces& places, const Pinhole& camera, const cv::Mat& inliers) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < places.first.size(); ++i)
    if (inliers.at<std::uint8_t>(static_cast<int>(i)) != 0)
      sum += direction(camera, places.second[i]) * direction(camera, places.first[i]).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Eigen::Matrix3d turn =
      svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  std::vector<double> left_px;
  for (std::size_t i = 0; i < places.first.size(); ++i) {
    const Eigen::Vector3d d = turn * direction(camera, places.first[i]);
    if (inliers.at<std::uint8_t>(static_cast<int>(i)) == 0 || d.z() <= 0) continue;
    left_px.push_back(std::hypot(camera.fx * d.x() / d.z() + camera.cx - places.second[i].x,
                                 camera.fy * d.y() / d.z() + camera.cy - places.second[i].y));
  }
  return left_px.empty() ? 0.0 : quantile_of(left_px, 0.5);
}

// The pose of the second camera, and the number of points that can be triangulated with it.
std::optional<FirstPair> relative_pose(const CommonPlaces& places, const Pinhole& camera,
                                       const BatchMotionOptions& options) {
  const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::Mat inliers;
  const cv::Mat essential = cv::findEssentialMat(places.first, places.second, k, cv::RANSAC, 0.9999,
                                                 options.outlier_px / 2, inliers);
  if (essential.rows != 3) return std::nullopt;
  cv::Mat rotation, translation;
  cv::recoverPose(essential, places.first, places.second, k, rotation, translation, inliers);
  if (parallax_px(places, camera, inliers) < options.outlier_px) return std::nullopt;
  FirstPair out{0, 0, pose_of(rotation, translation), 0};
  for (std::size_t i = 0; i < places.first.size(); ++i) {
    if (inliers.at<std::uint8_t>(static_cast<int>(i)) == 0) continue;
    const PosedObservation both[] = {{BundlePose{}, {places.first[i].x, places.first[i].y}},
                                     {out.second_pose, {places.second[i].x, places.second[i].y}}};
    if (triangulated_point(both, camera, {options.least_angle_deg, options.outlier_px})) ++out.points;
  }
  return out;
}

// Why there is no pair: too few points, no movement, or a rotation alone.
Error no_pair(std::span<const PointTrack> tracks, std::span<const int> keyframes,
              const BatchMotionOptions& options) {
  std::size_t most_common = 0;
  double moved_px = 0.0;
  for (std::size_t b = 1; b < keyframes.size(); ++b)
    for (const int a : {keyframes[b - 1], keyframes[0]}) {
      const CommonPlaces places = common_places(tracks, a, keyframes[b]);
      most_common = std::max(most_common, places.first.size());
      std::vector<double> steps;
      for (std::size_t i = 0; i < places.first.size(); ++i)
        steps.push_back(
            std::hypot(places.first[i].x - places.second[i].x, places.first[i].y - places.second[i].y));
      if (steps.size() >= static_cast<std::size_t>(options.least_points))
        moved_px = std::max(moved_px, quantile_of(steps, 0.5));
    }
  if (most_common < 2 * static_cast<std::size_t>(options.least_points))
    return invalid_input(
        "hardly any point can be followed from picture to picture: the model needs texture (put it on a "
        "printed "
        "cloth or a newspaper), even light, and a slower camera");
  if (moved_px < options.outlier_px)
    return invalid_input("the camera did not move: record it again, moving slowly around the model");
  return invalid_input(
      "the camera only turned, or hardly moved sideways, so depth cannot be measured: record it again, "
      "walking "
      "slowly around the model with all of it in view");
}

}  // namespace

Result<FirstPair> choose_first_pair(std::span<const PointTrack> tracks, std::span<const int> keyframes,
                                    const Pinhole& camera, const BatchMotionOptions& options,
                                    const Work& work) {
  FirstPair best;
  const int count = static_cast<int>(keyframes.size());
  for (int a = 0; a + 1 < count; a += std::max(1, count / 6)) {
    for (int b = a + 1; b < count; ++b) {
      if (work.cancelled()) return Work::interrupted();
      const CommonPlaces places = common_places(tracks, keyframes[static_cast<std::size_t>(a)],
                                                keyframes[static_cast<std::size_t>(b)]);
      if (static_cast<int>(places.first.size()) < 2 * options.least_points) continue;
      auto pair = relative_pose(places, camera, options);
      if (!pair || pair->points <= best.points) continue;
      pair->first = a, pair->second = b;
      best = *pair;
    }
  }
  if (best.points < options.least_points) return no_pair(tracks, keyframes, options);
  return best;
}

}  // namespace palpable::vision
