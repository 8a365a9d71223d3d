// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

#include <cstdint>
#include <string_view>

namespace palpable::bench {

/// Synthetic meshes like those of scanners and sculpting programs, from seeds. The parameters of fields are
/// chosen on them.
enum class ScannedKind {
  /// A ball whose vertices are displaced at random along its normals, like scanner noise.
  noisy_ball,
  /// A superquadric with many small bumps, and a little noise.
  bumpy_superquadric,
  /// A block with a fractal terrain on top.
  terrain,
  /// A smooth body into which three balls sink. It is cut along their intersections.
  overlapping_bodies
};
std::string_view name_of(ScannedKind kind);

/// A mesh of closed bodies, about `triangles` triangles oriented outwards; its longest side is `longest_m`.
/// Deterministic.
Mesh scanned_mesh(ScannedKind kind, std::uint32_t seed, int triangles, double longest_m);

}  // namespace palpable::bench
