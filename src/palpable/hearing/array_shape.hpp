// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/sound/microphones.hpp"

#include <cstdint>
#include <optional>

namespace palpable::hearing {

/// Which directions an array of microphones tells apart.
enum class ArrayShape : std::uint8_t {
  /// Every direction.
  spatial,
  /// Microphones in a level plane: above and below look alike, so the azimuth alone is determined.
  level,
  /// Microphones in another plane: a direction and its mirror image behind the plane look alike.
  upright
};

struct ArrayGeometry {
  ArrayShape shape = ArrayShape::spatial;
  /// Unit normal of the plane towards the side that is searched: upwards, or ahead. Spatial: zero.
  Vec3 normal;
  /// The greatest distance between two microphones.
  double aperture_m = 0.0;
};

/// Errors, invalid_input: fewer than three microphones or more than 64, a position that is not finite or
/// farther than 10 m, two at one place or more than 3 m apart, all of them on a line (which leaves a cone of
/// directions), or in an upright plane that runs ahead, which does not tell left from right; a speed of sound
/// outside of 100 to 2000 m/s.
Result<ArrayGeometry> geometry_of(const Microphones& microphones);

/// Where a sound comes from, seen from the array.
struct Bearing {
  /// From straight ahead, positive to the right; -180 to 180.
  double azimuth_deg = 0.0;
  /// Above the horizontal; absent if the array does not determine it.
  std::optional<double> elevation_deg;
};

/// `direction`: towards the sound, not zero.
Bearing bearing_of(Vector<CameraFrame> direction, ArrayShape shape);
/// The unit vector of angles in degrees.
Vector<CameraFrame> direction_at(double azimuth_deg, double elevation_deg);

}  // namespace palpable::hearing
