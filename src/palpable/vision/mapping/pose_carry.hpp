// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// How errors of a pose are carried along; of this folder's sources only, since it needs Eigen.

#include "palpable/vision/mapping/alignment.hpp"

#include <Eigen/Core>

namespace palpable::vision {

using PoseMatrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

inline Eigen::Map<const PoseMatrix6> eigen_of(const PoseMatrix& matrix) {
  return Eigen::Map<const PoseMatrix6>(matrix.data());
}

Eigen::Map<const PoseMatrix6> eigen_of(PoseMatrix&&) = delete;

inline PoseMatrix matrix_of(const PoseMatrix6& matrix) {
  PoseMatrix values;
  Eigen::Map<PoseMatrix6>(values.data()) = matrix;
  return values;
}

/// What becomes of a pose's error when the camera moves on by `way`, in the axes of the world: a turn moves
/// what is ahead.
inline PoseMatrix6 carried_by(Vec3 way_m) {
  PoseMatrix6 carry = PoseMatrix6::Identity();
  carry.block<3, 3>(3, 0) << 0.0, way_m.z, -way_m.y, -way_m.z, 0.0, way_m.x, way_m.y, -way_m.x, 0.0;
  return carry;
}

}  // namespace palpable::vision
