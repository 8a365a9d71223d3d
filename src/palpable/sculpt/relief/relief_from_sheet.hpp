// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"

#include <vector>

namespace palpable::sculpt {

/// How a sheet of triangles becomes a relief.
struct SheetOptions {
  /// Samples along the longer side, 2 ... 4096.
  int samples_on_a_side = 1024;
  /// The sheet's lowest point stands so high above the base, which is felt where there is no sheet; 0 ... 10
  /// mm.
  double thickness_m = 0.001;
  /// No place of the relief becomes steeper than this (rise over run), 0.1 ... 100.
  double steepest_slope = 3.0;
};
std::vector<Parameter> parameters_of(SheetOptions& options);

/// Which way a mesh's area faces: the sum of the triangles' area vectors over the sum of their areas. Length
/// 0 for a closed surface, 1 for a flat sheet; (0, 0, 0) for a mesh without area. Triangles with a vertex
/// that is not finite or not there are left out.
Vec3 mean_facing(const Mesh& mesh);

/// Whether a mesh is an open sheet, which encloses no solid: it is flat, or it faces one way with more than
/// three quarters of its area (a half ball without its base faces one way with a half).
bool is_open_sheet(const Mesh& mesh);

/// The height of the highest point of a mesh on vertical lines through the middles of `width` x `height`
/// pixels, row 0 at the greatest y, pixel (0, 0) with its outer corner at (left_m, top_m): exact, as rays
/// that meet the triangles' planes. NaN where a line meets no triangle; lines through an edge meet it.
/// Triangles that are seen edge-on, or have a vertex that is not finite or not there, are left out. Errors:
/// interrupted.
Result<Raster<float>> heights_from_above(const Mesh& mesh, double left_m, double top_m, double pixel_m,
                                         int width, int height, const Work& work);

/// The relief of what is seen of a mesh from +z, in the scene frame's axes and metres. The mesh is centred
/// above the origin with its lowest point at z = 0 or above, so that the relief lies in its place. Long work:
/// polls cancel. Errors: usage for options out of range, invalid_input for a mesh without an extent,
/// interrupted.
Result<models::Relief> relief_from_sheet(const Mesh& mesh, const SheetOptions& options, const Work& work);

}  // namespace palpable::sculpt
