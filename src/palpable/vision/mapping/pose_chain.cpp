// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/pose_chain.hpp"

#include "palpable/vision/mapping/pose_carry.hpp"

#include <Eigen/Cholesky>

namespace palpable::vision {

void PoseChain::move(const WorldPose& from, const WorldPose& to, const PoseMatrix& error) {
  const PoseMatrix6 carry = carried_by(to.translation_m - from.translation_m);
  const PoseMatrix6 sum = carry * eigen_of(drift_) * carry.transpose() + PoseMatrix6(eigen_of(error));
  drift_ = matrix_of(sum);
}

void PoseChain::keep(const PosedDepth& frame, double time_s) {
  if (!pictures_.empty()) {
    const PoseError motion =
        motion_between(pictures_.back().posed.world_from_camera, frame.world_from_camera);
    const double turn_rad = norm(Vec3{motion[0], motion[1], motion[2]});
    if (turn_rad < options_.kept_rad && norm(Vec3{motion[3], motion[4], motion[5]}) < options_.kept_m) return;
  }
  pictures_.push_back({frame, time_s, drift_});
  if (pictures_.size() > options_.most_kept) thin();
}

void PoseChain::thin() {
  const std::size_t older = pictures_.size() / 2;
  std::size_t place = 0;
  std::erase_if(pictures_, [&](const KeptPicture&) { return place++ < older && place % 2 == 0; });
}

void PoseChain::close(const WorldPose& newest, const WorldPose& found) {
  const PoseError error = motion_between(newest, found);
  // What is certain stays.
  constexpr double kLeast = 1e-10;
  const PoseMatrix6 certain = kLeast * PoseMatrix6::Identity();
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(
      Eigen::Matrix<double, 6, 6>(eigen_of(drift_) + certain));
  using Column = Eigen::Matrix<double, 6, 1>;
  const Column share = solver.solve(Eigen::Map<const Column>(error.data()));
  for (KeptPicture& picture : pictures_) {
    WorldPose& pose = picture.posed.world_from_camera;
    // The covariance of the two poses' errors, times that.
    const PoseMatrix6 carry = carried_by(newest.translation_m - pose.translation_m);
    PoseError motion;
    Eigen::Map<Column>(motion.data()) = eigen_of(picture.drift) * carry.transpose() * share;
    pose = moved_by(pose, motion);
    picture.drift = {};
  }
  drift_ = {};
}

}  // namespace palpable::vision
