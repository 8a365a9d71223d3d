// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/sculpt/distance_source.hpp"

#include <memory>

namespace palpable::sculpt {

/// The distance to a mesh's triangles (at least one, all with an area, facing outwards): of an edge or a
/// corner whose triangles close up, the side is told by their normals (angle-weighted pseudo-normals,
/// Baerentzen & Aanaes 2005); where they do not (rims; corners that stand on other triangles' edges), or
/// hardly tell, by the winding number of `whole`, the mesh that the surface was taken from.
std::unique_ptr<DistanceSource> mesh_distance(const Mesh& surface, const Mesh& whole);

}  // namespace palpable::sculpt
