// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <span>

namespace palpable::sculpt {

/// Orthonormal axes, right-handed, along which points around a centre are most independent (FastICA with the
/// fourth moment, symmetric: Hyvarinen 1999). Second moments do not tell the axes of a cube; these do. At
/// least one point that is not the centre; any unit. Deterministic.
std::array<Vec3, 3> independent_axes(std::span<const Vec3> points, Vec3 centre);

}  // namespace palpable::sculpt
