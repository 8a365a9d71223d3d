// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/solid/small_facets.hpp"

#include <memory>
#include <vector>

namespace palpable::sculpt {

/// The signed distance to a mesh's triangles (at least one, all with an area, facing outwards). At an edge or
/// a corner of a closed mesh, the sign follows from the triangles' normals (angle-weighted pseudo-normals,
/// Baerentzen & Aanaes 2005). For other meshes (with rims, or with corners on edges of other triangles), and
/// where the normals are ambiguous, it follows from the winding number of `whole`, the mesh from which the
/// surface was taken. `tolerances`: how closely a field has to follow each triangle (DistanceSource::Hint);
/// empty for exactly.
std::unique_ptr<DistanceSource> mesh_distance(const Mesh& surface, const Mesh& whole,
                                              std::vector<FacetTolerance> tolerances = {});

}  // namespace palpable::sculpt
