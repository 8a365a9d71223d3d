// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/plane_fit.hpp"

#include <Eigen/Eigenvalues>

namespace palpable::sculpt {

Plane plane_through(std::span<const Vec3> points_m) {
  Vec3 mean;
  for (const Vec3 p : points_m) mean += p;
  mean = mean / static_cast<double>(points_m.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vec3 p : points_m) {
    const Eigen::Vector3d d(p.x - mean.x, p.y - mean.y, p.z - mean.z);
    scatter += d * d.transpose();
  }
  if (!(scatter.trace() > 0.0)) return {{0.0, 0.0, 1.0}, mean.z};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d n = solver.eigenvectors().col(0);
  const Vec3 normal{n.x(), n.y(), n.z()};
  return {normal, dot(normal, mean)};
}

}  // namespace palpable::sculpt
