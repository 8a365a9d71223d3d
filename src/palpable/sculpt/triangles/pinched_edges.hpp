// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

namespace palpable::sculpt {

/// Separates sheets of a surface that touch at an edge or a vertex, as contouring leaves them where two
/// sheets pass through one cube: the vertices there are divided, at the same places, so that each edge is
/// used by two triangles. At an edge of several triangles those are connected that bound the same part of the
/// solid. Where sheets that meet at an edge are connected around its ends, each gets a vertex of its own in
/// the middle of that edge instead. Triangles must face outwards and refer to vertices that exist. Other
/// defects remain (is_watertight()).
Mesh with_pinches_divided(const Mesh& mesh);

}  // namespace palpable::sculpt
