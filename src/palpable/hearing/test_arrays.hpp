// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/sound/microphones.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::hearing {

/// Four microphones on a level cross.
inline const Microphones kLevelArray{{{{0.1, 0, 0}}, {{-0.1, 0, 0}}, {{0, 0, 0.1}}, {{0, 0, -0.1}}}};

/// Between unit vectors.
inline double angle_deg(Vec3 a, Vec3 b) { return std::acos(std::min(1.0, dot(a, b))) * 57.29578; }

}  // namespace palpable::hearing
