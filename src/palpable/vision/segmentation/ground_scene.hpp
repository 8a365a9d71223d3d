// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/vec3.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

// For tests: scenes whose ground is known.
namespace palpable::vision {

/// The class of a pixel in a scene with known ground.
enum class Seen : std::uint8_t { nothing, ground, object };

struct Shares {
  double ground_found = 0.0;
  double object_lost = 0.0;
};

/// The shares of ground pixels and of object pixels that a mask marks.
inline Shares shares_of(const Raster<std::uint8_t>& mask, const Raster<Seen>& seen) {
  double ground = 0, found = 0, object = 0, lost = 0;
  for (std::size_t i = 0; i < seen.count(); ++i) {
    const bool marked = mask.values()[i] != 0;
    ground += seen.values()[i] == Seen::ground ? 1 : 0;
    found += seen.values()[i] == Seen::ground && marked ? 1 : 0;
    object += seen.values()[i] == Seen::object ? 1 : 0;
    lost += seen.values()[i] == Seen::object && marked ? 1 : 0;
  }
  return {found / ground, lost / object};
}

inline double degrees_between(Vec3 a, Vec3 b) {
  return 180.0 / std::numbers::pi * std::acos(std::min(1.0, dot(unit(a), unit(b))));
}

}  // namespace palpable::vision
