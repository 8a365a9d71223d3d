// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/followed_view.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace palpable::vision {
namespace {

Eigen::Quaterniond turn_of(const FollowedView::Pose& pose) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> r(pose.rotation.data());
  return Eigen::Quaterniond(Eigen::Matrix3d(r)).normalized();
}

}  // namespace

const FollowedView::Pose& FollowedView::add(const Pose& camera, double dt_s) {
  if (!view_) return view_.emplace(camera);
  const Eigen::Quaterniond from = turn_of(*view_);
  const Eigen::Quaterniond to = turn_of(camera);
  const double gap_m = norm(camera.translation_m - view_->translation_m);
  const double gap_rad = from.angularDistance(to);
  if (gap_m > options_.far_m || gap_rad > options_.far_rad) follows_ = true;
  if (gap_m < options_.near_m && gap_rad < options_.near_rad) follows_ = false;
  if (!follows_) return *view_;
  const double share = 1.0 - std::exp(-dt_s / options_.time_s);
  const Eigen::Matrix3d turned = from.slerp(share, to).normalized().toRotationMatrix();
  for (std::size_t i = 0; i < 9; ++i)
    view_->rotation[i] = turned(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
  view_->translation_m += share * (camera.translation_m - view_->translation_m);
  return *view_;
}

}  // namespace palpable::vision
