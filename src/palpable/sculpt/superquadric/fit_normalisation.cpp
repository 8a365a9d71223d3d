// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/fit_normalisation.hpp"

#include "palpable/sculpt/superquadric/superquadric_starts.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/Dense>

namespace palpable::sculpt {

Result<Normalisation> normalisation_of(std::span<const Vec3> points) {
  constexpr std::size_t kFewestPoints = 12;
  if (points.size() < kFewestPoints) return invalid_input("a superquadric needs at least 12 points");
  if (!std::all_of(points.begin(), points.end(), [](Vec3 p) { return is_finite(p); }))
    return invalid_input("a point's position is not a finite number");
  const Vec3 centre = median_of(points);
  std::vector<double> lengths;
  lengths.reserve(points.size());
  for (const Vec3 p : points) lengths.push_back(norm(p - centre));
  const double scale = median_of(std::move(lengths));
  if (!(scale > 0.0)) return invalid_input("the points are all at one place");
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Vec3 p : points) {
    const Vec3 d = (p - centre) / scale;
    moments += Eigen::Vector3d(d.x, d.y, d.z) * Eigen::RowVector3d(d.x, d.y, d.z);
  }
  const Eigen::Vector3d values = moments.selfadjointView<Eigen::Lower>().eigenvalues();
  if (values[0] < 1e-8 * values[2])
    return invalid_input("the points lie on one plane or line, which no solid is fitted to");
  return Normalisation{centre, scale};
}

}  // namespace palpable::sculpt
