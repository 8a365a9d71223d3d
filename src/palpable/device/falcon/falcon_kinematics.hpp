// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <optional>

namespace palpable::device {

/// The angles of the Falcon's three arms, radians.
using ArmAngles = std::array<double, 3>;

/// The Falcon's linkage: three legs of an arm and a parallelogram each, as in Tsai & Stamper, "A Parallel
/// Manipulator with Only Translational Degrees of Freedom" (1997), with the dimensions that the public
/// drivers use. Its frame: the origin in the middle of the base, x to the right, y up, z out of the base
/// towards the user; metres. All functions: any thread, no allocation.
namespace falcon {

/// The middle of the workspace that is used.
inline constexpr Vec3 kCentre_m{0.0, 0.0, 0.115};
/// Its size; everywhere in it the arms determine the place, and the other way round.
inline constexpr Vec3 kWorkspace_m{0.08, 0.08, 0.07};

/// The angles of the arms, with the elbows outside. nullopt beyond the legs' reach.
std::optional<ArmAngles> angles_at(Vec3 place_m) noexcept;

/// The place of the grip by Newton's method, from `near_m`, the last place. nullopt if no place near there
/// has these angles, or if they do not determine it.
std::optional<Vec3> place_of(const ArmAngles& angles, Vec3 near_m = kCentre_m) noexcept;

/// d(place)/d(angle): one vector per arm, m/rad. nullopt where the arms do not determine the place.
std::optional<std::array<Vec3, 3>> jacobian(const ArmAngles& angles, Vec3 place_m) noexcept;

/// The motors' torques for a force on the grip, tau = J^T F, N m. nullopt as jacobian().
std::optional<std::array<double, 3>> torques(const ArmAngles& angles, Vec3 place_m, Vec3 force_N) noexcept;

}  // namespace falcon
}  // namespace palpable::device
