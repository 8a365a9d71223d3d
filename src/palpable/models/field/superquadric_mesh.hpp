// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/models/field/superquadric.hpp"

namespace palpable::models {

/// The outward unit normal of the deformed surface for the undeformed surface's point `p`, in the shape's
/// frame.
Vec3 surface_normal(const Superquadric& shape, Vec3 p) noexcept;

/// A closed mesh of the deformed surface in the scene's frame: a box's grid of quads of about `spacing_m`,
/// projected onto the surface from its centre. The spacing is increased to keep the mesh below a few million
/// triangles.
Mesh mesh_of(const Superquadric& shape, double spacing_m);

}  // namespace palpable::models
