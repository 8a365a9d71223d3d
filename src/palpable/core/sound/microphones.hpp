// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <numbers>
#include <vector>

namespace palpable {

/// An array of microphones.
struct Microphones {
  /// One for each channel of the sound, in its order. The camera's axes: x right, y down, z ahead.
  std::vector<Point<CameraFrame>> positions_m;
  /// In dry air of 20 degrees Celsius.
  double speed_of_sound_m_per_s = 343.2;
};

/// Four microphones on the corners of a level square, which is straight ahead: ahead at the left, ahead at
/// the right, behind at the right, behind at the left. `radius_m`: from its middle, the origin.
inline Microphones square_array(double radius_m) {
  const double side = radius_m / std::numbers::sqrt2;
  return {{{{-side, 0.0, side}}, {{side, 0.0, side}}, {{side, 0.0, -side}}, {{-side, 0.0, -side}}}};
}

}  // namespace palpable
