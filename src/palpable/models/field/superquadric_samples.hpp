// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <vector>

namespace palpable::models {

/// A place of a surface with its outward unit normal.
struct SurfaceSample {
  Point<SceneFrame> place;
  Vector<SceneFrame> normal;
};

/// The outward unit normal of the deformed surface at the undeformed surface's point `p`, in the shape's
/// frame.
Vec3 surface_normal(const Superquadric& shape, Vec3 p) noexcept;

/// A closed mesh of the deformed surface in the scene's frame: a box's grid of quads of about `spacing_m`,
/// drawn onto the surface from its centre. No more than a few million triangles are made: the spacing is
/// raised where there would be more.
Mesh mesh_of(const Superquadric& shape, double spacing_m);

/// Points of the surface spread evenly: no two nearer than `spacing_m`, and no place of the surface farther
/// than about 1.3 times that from one of them. The same shape and spacing give the same points.
std::vector<SurfaceSample> even_samples(const Superquadric& shape, double spacing_m);

}  // namespace palpable::models
