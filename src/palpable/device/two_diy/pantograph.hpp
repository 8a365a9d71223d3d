// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

namespace palpable::device {

/// A place or a force in the plane of a pantograph: the first motor's axis is the origin, the second's lies
/// on the x axis, and the handle on the side of positive y. Metres, or newtons.
struct InPlane {
  double x = 0.0;
  double y = 0.0;
};

/// The angles of the two inner links against the x axis, counter-clockwise, radians.
using LinkAngles = std::array<double, 2>;

/// A five-bar linkage: two motors `base_m` apart (0 = on one axis) turn the inner links; two outer links join
/// these with the handle (Campion, Wang & Hayward, IROS 2005). All functions: any thread, no allocation.
struct Pantograph {
  double inner_m = 0.07;
  double outer_m = 0.09;
  double base_m = 0.038;

  /// The handle's place: of the two intersections of the outer links the one with the greater y. nullopt
  /// where the links do not meet, lie on one line, or where the elbows coincide: there the place, or the
  /// forces, are not determined by the angles.
  std::optional<InPlane> handle_at(LinkAngles angles) const noexcept;
  /// The angles with the elbows outside; the first in (-pi/2, 3 pi/2], the second in (-3 pi/2, 3 pi/2].
  /// nullopt beyond the links' reach.
  std::optional<LinkAngles> angles_at(InPlane place) const noexcept;
  /// d(x, y)/d(angle) per motor: {d/d first, d/d second}, m/rad. nullopt as handle_at().
  std::optional<std::array<InPlane, 2>> jacobian(LinkAngles angles) const noexcept;
  /// The motors' torques for a force on the handle, tau = J^T F, N m. nullopt as handle_at().
  std::optional<std::array<double, 2>> torques(LinkAngles angles, InPlane force_N) const noexcept;
};

}  // namespace palpable::device
