// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <memory>

namespace palpable::sculpt {

/// The distance to a mesh's triangles (at least one, all with an area, facing outwards). Of an edge or a
/// corner of a mesh that is closed all over, the sign follows from its triangles' normals (angle-weighted
/// pseudo-normals, Baerentzen & Aanaes 2005); of other meshes (with rims, or corners that lie on other
/// triangles' edges), and where the normals are ambiguous, from the winding number of `whole`, the mesh that
/// the surface was taken from.
std::unique_ptr<DistanceSource> mesh_distance(const Mesh& surface, const Mesh& whole);

}  // namespace palpable::sculpt
