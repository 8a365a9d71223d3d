// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::sources {

/// Greatest number of corners of a face. No program writes faces with more, and the time of triangulation
/// grows with the square of the number.
inline constexpr std::size_t kMostCorners = 1024;

/// Triangulates a planar face and appends the triangles with the same orientation. `corners` (3 to
/// kMostCorners) are valid indices into `vertices`. Quadrilaterals are split at their reflex corner; larger
/// faces are split as a fan if convex, else by ear clipping (Meisters 1975).
void append_triangles(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners,
                      std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace palpable::sources
