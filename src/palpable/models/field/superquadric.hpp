// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"

#include <array>

namespace palpable::models {

/// A superquadric's own frame: metres, origin at its centre, tapered and bent along its z axis.
struct ShapeFrame;

/// A superquadric (Moustakas 2007, eq. 1), tapered, then bent, then placed in the scene (Jaklic, Leonardis,
/// Solina 2000). A value type. With exponents up to 2 the undeformed body is convex.
struct Superquadric {
  /// Half axes a1, a2, a3 > 0 in metres.
  Vec3 size_m{0.01, 0.01, 0.01};
  /// e1 along z, e2 around it, each 0.05 ... 1.9: 0.05 nearly a box, 1 an ellipsoid, 1.9 an octahedron.
  double e1 = 1.0;
  double e2 = 1.0;
  /// K_x, K_y: the section at z is scaled by 1 + K z / a3; |K| < 1.
  double taper_x = 0.0;
  double taper_y = 0.0;
  /// Curvature of the bent z axis, >= 0, and the direction it bends towards, as an angle from x. Every point
  /// must stay on its side of the centre of curvature: bend_per_m * reach < 1.
  double bend_per_m = 0.0;
  double bend_angle_rad = 0.0;
  /// Pose; its scale is 1.
  Transform<SceneFrame, ShapeFrame> scene_from_shape;

  bool deformed() const { return taper_x != 0.0 || taper_y != 0.0 || bend_per_m != 0.0; }
};

constexpr double kLeastExponent = 0.05;
constexpr double kGreatestExponent = 1.9;

/// Whether the numbers are finite and in their ranges. Errors: invalid_input.
Result<void> check_superquadric(const Superquadric& shape);

/// The factor by which the undeformed body must be scaled to reach `p` (in its own frame, before taper and
/// bend): below 1 inside, 1 on the surface. It equals F^(e1/2), computed without overflow or negative bases,
/// and is homogeneous of degree 1.
double gauge(const Superquadric& shape, Vec3 p) noexcept;
/// The same with its gradient; zero at the centre.
double gauge(const Superquadric& shape, Vec3 p, Vec3& gradient_per_m) noexcept;

/// The papers' inside-outside function F^e1 = gauge^2 of the undeformed shape at a point of the scene: above
/// 1 outside, below 1 inside.
double inside_outside(const Superquadric& shape, Point<SceneFrame> p) noexcept;

/// Applies taper and bend to a point in the shape's frame, and the inverse. The taper's factor is clamped
/// beyond the ends.
Vec3 deform(const Superquadric& shape, Vec3 p) noexcept;
Vec3 undeform(const Superquadric& shape, Vec3 p) noexcept;
/// A point with the columns of deform()'s Jacobian there.
struct DeformedPoint {
  Vec3 place;
  Vec3 by_x, by_y, by_z;
};
DeformedPoint deform_with_jacobian(const Superquadric& shape, Vec3 p) noexcept;

/// The undeformed surface's point on the ray from the centre through `p`, which is not the centre.
Vec3 on_surface(const Superquadric& shape, Vec3 p) noexcept;

/// Greatest distance of a point of the body from the origin of its frame, before bending.
double reach_m(const Superquadric& shape) noexcept;

/// Rotations as unit quaternions w, x, y, z with w >= 0, and as row-major matrices.
std::array<double, 4> quaternion_of(const std::array<double, 9>& rotation) noexcept;
std::array<double, 9> rotation_of(const std::array<double, 4>& quaternion) noexcept;

}  // namespace palpable::models
