// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/first_pair.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/motion/structure/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

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

// The rotation that maps the first directions onto the second ones best (Kabsch 1976).
Eigen::Matrix3d turn_between(const std::vector<Eigen::Vector3d>& first,
                             const std::vector<Eigen::Vector3d>& second) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < first.size(); ++i) sum += second[i] * first[i].transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

// Median parallax, px: the movement of points after the camera's rotation and zoom that explain most of it
// are removed. Without parallax depth cannot be determined.
double parallax_px(const CommonPlaces& places, const Pinhole& camera, const cv::Mat& inliers) {
  std::vector<Eigen::Vector3d> first;
  std::vector<Eigen::Vector2d> second;
  for (std::size_t i = 0; i < places.first.size(); ++i) {
    if (inliers.at<std::uint8_t>(static_cast<int>(i)) == 0) continue;
    first.push_back(direction(camera, places.first[i]));
    second.emplace_back((places.second[i].x - camera.cx) / camera.fx,
                        (places.second[i].y - camera.cy) / camera.fy);
  }
  std::vector<double> left_px;
  // Rotation and zoom in turn; both are almost independent, so few rounds suffice.
  constexpr int kRounds = 8;
  double zoom = 1.0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Eigen::Vector3d> directions;
    directions.reserve(second.size());
    for (const Eigen::Vector2d& p : second) directions.push_back((p / zoom).homogeneous().normalized());
    const Eigen::Matrix3d turn = turn_between(first, directions);
    left_px.clear();
    double along = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      const Eigen::Vector3d d = turn * first[i];
      if (d.z() <= 0) continue;
      const Eigen::Vector2d turned = d.hnormalized();
      left_px.push_back(camera.fx * (zoom * turned - second[i]).norm());
      along += turned.dot(second[i]), squares += turned.squaredNorm();
    }
    constexpr double kLeast = 0.1, kMost = 10.0;
    if (squares > 0) zoom = std::clamp(along / squares, kLeast, kMost);
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
      "the camera only turned or zoomed, or hardly moved sideways, so depth cannot be measured: record it "
      "again, without zoom, walking "
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
