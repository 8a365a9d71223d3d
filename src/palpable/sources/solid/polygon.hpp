// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::sources {

/// More corners than this are no face that any program writes; cutting it takes the square of their number.
inline constexpr std::size_t kMostCorners = 1024;

/// Appends the triangles of a plane face, turning as it does. `corners` (at least 3, at most kMostCorners)
/// are indices of `vertices`, all in range. Quadrilaterals are cut at their reflex corner, larger faces as a
/// fan where they are convex, else ear by ear (Meisters 1975).
void append_triangles(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners,
                      std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace palpable::sources
