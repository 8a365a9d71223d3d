// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/superquadric.hpp"
#include "palpable/sculpt/superquadric/superquadric_kernel.hpp"

#include <array>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// A line of sight that touches a solid: a point of its outline in a picture.
struct LineOfSight {
  Vec3 origin_m;
  Vec3 direction;  // unit
};

/// The parameters of the fit: 11 numbers, 13 with taper, 15 with bend. The rotation is a small rotation
/// after a reference; half axes are logarithms; exponents and tapers pass through sigmoids. So there are no
/// bounds.
constexpr int kPlainParameters = 11;
constexpr int kTaperParameters = 13;
constexpr int kBendParameters = 15;
constexpr int kMostParameters = kBendParameters;
using Parameters = std::array<double, kMostParameters>;

/// The shape that the parameters describe, and the parameters of a shape (its rotation goes into
/// `reference`).
models::Superquadric shape_from(const Parameters& parameters, const std::array<double, 9>& reference);
Parameters parameters_of(const models::Superquadric& shape, std::array<double, 9>& reference);

/// One residual with its derivative by every parameter.
struct Residual {
  double value = 0.0;
  std::array<double, kMostParameters> by{};
};

/// Residuals of points and lines of sight at one set of parameters. Immutable: any thread.
class ResidualsAt {
 public:
  ResidualsAt(const Parameters& parameters, const std::array<double, 9>& reference, int count);

  /// |r| (1 - 1 / gauge), the distance along the ray from the centre, exact there.
  double radial(Vec3 p) const;
  Residual radial_with_derivatives(Vec3 p) const;
  /// sqrt(a1 a2 a3) (F^e1 - 1), the cost of Solina & Bajcsy 1990.
  double solina(Vec3 p) const;
  Residual solina_with_derivatives(Vec3 p) const;

  /// The points of lines of sight nearest to the shape (where the gauge is least): there the radial distance
  /// of a line that touches it is 0. By the envelope theorem the point's own motion does not count in
  /// derivatives.
  Columns nearest_on(std::span<const LineOfSight> sights) const;

  /// The radial distances of points from the shape.
  void radial_distances_of(const Columns& places, RadialDistances& out) const;
  /// Whether the surface nearest to point i of `places` faces `eye`.
  bool faces(Vec3 place, Vec3 outward, Vec3 eye) const;

  /// Weighted radial residuals of all points, and unless `jacobian` is null their derivatives, column after
  /// column.
  void radial_rows_of(const Columns& places, std::span<const double> weights, double* residuals,
                      double* jacobian) const;

  const models::Superquadric& shape() const { return shape_; }

 private:
  struct Gauge {
    double value;
    Vec3 by_place;  // before deformation
    Vec3 by_log_size;
    double by_e1, by_e2;
  };
  Vec3 local(Vec3 p) const;
  Gauge gauge_with_derivatives(Vec3 straight) const;
  /// From derivatives by the undeformed place to those by all parameters.
  void chain(Vec3 placed, Vec3 straight, Vec3 by_straight, const Gauge& gauge, double by_gauge,
             Residual& out) const;

  models::Superquadric shape_;
  Parameters parameters_;
  int count_;
  std::array<double, 9> turned_{};  // right Jacobian of the small turn
  double e1_rate_, e2_rate_;        // d exponent / d parameter
};

}  // namespace palpable::sculpt
