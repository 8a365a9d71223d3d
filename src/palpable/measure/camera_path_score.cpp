// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/camera_path_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

namespace palpable::measure {
namespace {

using Matrix = Eigen::Matrix3d;
using Place = Eigen::Vector3d;

struct PosePair {
  Matrix found_rotation, true_rotation;
  Place found_place, true_place;
};

template <class World>
Matrix rotation_matrix(const Transform<World, CameraFrame>& pose) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.rotation.data());
}

Place vector_of(Vec3 v) { return {v.x, v.y, v.z}; }

// In the order of the frames.
std::vector<PosePair> pairs_of(std::span<const FoundPose> found, std::span<const TruePose> truth) {
  std::map<int, const FoundPose*> found_in;
  for (const FoundPose& pose : found) found_in[pose.frame] = &pose;
  std::map<int, PosePair> pairs;
  for (const TruePose& pose : truth) {
    const auto match = found_in.find(pose.frame);
    if (match == found_in.end()) continue;
    const auto& other = match->second->pose;
    pairs[pose.frame] = {rotation_matrix(other), rotation_matrix(pose.pose), vector_of(other.translation_m),
                         vector_of(pose.pose.translation_m)};
  }
  std::vector<PosePair> out;
  for (const auto& [frame, pair] : pairs) out.push_back(pair);
  return out;
}

// The rotation R for which R * found is nearest to the true rotations (chordal mean, Hartley et al. 2013).
Matrix common_rotation(const std::vector<PosePair>& pairs) {
  Matrix sum = Matrix::Zero();
  for (const PosePair& pair : pairs) sum += pair.true_rotation * pair.found_rotation.transpose();
  const Eigen::JacobiSVD<Matrix> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  return svd.matrixU() * Place(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

double angle_deg(const Matrix& rotation) {
  // From the sine of half the angle, since the cosine of a small angle rounds to one.
  const double half_sine = (rotation - Matrix::Identity()).norm() / (2 * std::numbers::sqrt2);
  return 2 * std::asin(std::clamp(half_sine, 0.0, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace

Result<CameraPathScore> score_camera_path(std::span<const FoundPose> found, std::span<const TruePose> truth) {
  const std::vector<PosePair> pairs = pairs_of(found, truth);
  constexpr std::size_t kLeastFrames = 3;
  if (pairs.size() < kLeastFrames)
    return invalid_input("fewer than three frames have both a found and a true pose");
  const double count = static_cast<double>(pairs.size());
  const Matrix rotation = common_rotation(pairs);
  Place found_mean = Place::Zero(), true_mean = Place::Zero();
  for (const PosePair& pair : pairs)
    found_mean += pair.found_place / count, true_mean += pair.true_place / count;
  double product = 0.0, found_square = 0.0, true_square = 0.0;
  for (const PosePair& pair : pairs) {
    const Place a = rotation * (pair.found_place - found_mean), b = pair.true_place - true_mean;
    product += a.dot(b), found_square += a.squaredNorm(), true_square += b.squaredNorm();
  }
  if (!(found_square > 0 && true_square > 0 && product > 0))
    return invalid_input("the cameras' positions do not determine the scale between the two worlds");

  CameraPathScore out;
  out.frames = static_cast<int>(pairs.size());
  out.missing_frames = static_cast<int>(truth.size() - pairs.size());
  const double scale = product / found_square;
  const Place shift = true_mean - scale * (rotation * found_mean);
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(out.true_from_found.rotation.data()) = rotation;
  out.true_from_found.scale = scale;
  out.true_from_found.translation_m = {shift.x(), shift.y(), shift.z()};

  double error_square = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PosePair& pair = pairs[i];
    if (i > 0) out.path_length += (pair.true_place - pairs[i - 1].true_place).norm();
    error_square += (scale * (rotation * pair.found_place) + shift - pair.true_place).squaredNorm();
    const double angle = angle_deg((rotation * pair.found_rotation).transpose() * pair.true_rotation);
    out.mean_rotation_deg += angle / count;
    out.most_rotation_deg = std::max(out.most_rotation_deg, angle);
  }
  out.position_rms_percent = 100 * std::sqrt(error_square / count) / out.path_length;
  return out;
}

}  // namespace palpable::measure
