// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <vector>

namespace palpable {

/// An array of microphones.
struct Microphones {
  /// One for each channel of the sound, in its order. The camera's axes: x right, y down, z ahead.
  std::vector<Point<CameraFrame>> positions_m;
  /// In dry air of 20 degrees Celsius.
  double speed_of_sound_m_per_s = 343.2;
};

}  // namespace palpable
