// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/superquadric.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// Points as a structure of arrays, so that loops over them are vectorised.
struct Columns {
  std::vector<double> x, y, z;

  Columns() = default;
  explicit Columns(std::size_t count) : x(count), y(count), z(count) {}
  std::size_t count() const { return x.size(); }
  Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, Vec3 p) { x[i] = p.x, y[i] = p.y, z[i] = p.z; }
  void resize(std::size_t count) { x.resize(count), y.resize(count), z.resize(count); }
};

/// The radial distances of points from an undeformed shape.
struct RadialDistances {
  /// |r| (1 - 1 / gauge): the distance along the ray from the centre.
  std::vector<double> radial;
  /// The share of it that is Euclidean distance to first order: the cosine between ray and normal.
  std::vector<double> euclidean_share;
  /// The gradient of the gauge in the shape's frame.
  Columns outward;

  void resize(std::size_t count) {
    radial.resize(count), euclidean_share.resize(count), outward.resize(count);
  }
};

/// Fills `out` for `local`, points in the shape's frame with taper and bend undone. Accurate to 1e-9 of the
/// shape's size.
void radial_distances(const models::Superquadric& shape, const Columns& local, RadialDistances& out);

/// Weighted radial residuals of an undeformed shape with their derivatives by the eleven parameters
/// (superquadric_residuals.hpp), column after column of `count` rows. `turned` is the right Jacobian of the
/// small rotation; e1_rate and e2_rate are the exponents' derivatives by their parameters. `jacobian` may be
/// null. `places` are in the scene's frame.
struct KernelShape {
  models::Superquadric shape;
  std::array<double, 9> turned;
  double e1_rate, e2_rate;
};
void radial_rows(const KernelShape& at, const Columns& places, std::span<const double> weights,
                 double* residuals, double* jacobian);

}  // namespace palpable::sculpt
