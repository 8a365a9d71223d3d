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

/// How the error of a pose continues in that of the next one, `moved_m` farther along the axes of the world:
/// an error of the turn adds one of the position.
inline PoseMatrix6 carried_by(Vec3 moved_m) {
  PoseMatrix6 carry = PoseMatrix6::Identity();
  carry.block<3, 3>(3, 0) << 0.0, moved_m.z, -moved_m.y, -moved_m.z, 0.0, moved_m.x, moved_m.y, -moved_m.x,
      0.0;
  return carry;
}

}  // namespace palpable::vision
