// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/independent_axes.hpp"

#include <Eigen/Dense>

namespace palpable::sculpt {
namespace {

/// The nearest orthonormal matrix.
Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace

std::array<Vec3, 3> independent_axes(std::span<const Vec3> points, Vec3 centre) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix3Xd white(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3 p = points[static_cast<std::size_t>(i)] - centre;
    white.col(i) = Eigen::Vector3d(p.x, p.y, p.z);
  }
  Eigen::Matrix3d covariance = white * white.transpose() / static_cast<double>(count);
  // Flat points have no scatter across.
  constexpr double kLeastScatter = 1e-6;
  covariance += kLeastScatter * covariance.trace() * Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(covariance);
  white = principal.operatorInverseSqrt() * white;
  // Principal axes of a symmetric body may be where the fourth moment is level: turned away from them.
  Eigen::Matrix3d axes = Eigen::AngleAxisd(0.5, Eigen::Vector3d(0.36, 0.48, 0.80)) * principal.eigenvectors();
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::Matrix3Xd along = axes.transpose() * white;
    axes = orthonormal(white * along.array().cube().matrix().transpose() -
                       3.0 * static_cast<double>(count) * axes);
  }
  // Back from the whitened space, where they are orthonormal.
  axes = orthonormal(principal.operatorSqrt() * axes);
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  const auto axis = [&](int k) { return Vec3{axes(0, k), axes(1, k), axes(2, k)}; };
  return {axis(0), axis(1), axis(2)};
}

}  // namespace palpable::sculpt
