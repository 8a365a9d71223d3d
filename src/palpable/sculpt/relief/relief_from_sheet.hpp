// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"

#include <vector>

namespace palpable::sculpt {

/// How a sheet of triangles becomes a relief.
struct SheetOptions {
  /// Samples along the longer side, 2 ... 4096.
  int samples_on_a_side = 1024;
  /// Height of the sheet's lowest point above the base, which is felt beside the sheet; 0 … 10 mm.
  double thickness_m = 0.001;
  /// No place of the relief becomes steeper than this (rise over run), 0.1 ... 100.
  double steepest_slope = 3.0;
  /// Length of the mean facing (mean_facing()) beyond which a mesh is an open sheet, 0.5 ... 1: a plane has
  /// 1, a half ball 0.5, slopes of up to about 45 degrees more than the default.
  double least_facing = 0.75;
  /// Length of the mean facing beyond which a mesh becomes the relief of the side that it faces, 0 ... 1.
  double faces_one_way = 0.5;
};
std::vector<Parameter> parameters_of(SheetOptions& options);

/// The mean direction of a mesh's area: the sum of the triangles' area vectors over the sum of their areas.
/// Length 0 for a closed surface, 1 for a flat sheet; (0, 0, 0) for a mesh without area. Triangles with a
/// vertex that is missing or not finite are omitted.
Vec3 mean_facing(const Mesh& mesh);

/// Whether a mesh is an open sheet, which encloses no solid: flat, or with a mean facing longer than
/// options.least_facing.
bool is_open_sheet(const Mesh& mesh, const SheetOptions& options = {});

/// The height of the highest point of a mesh on the vertical lines through the centres of `width` x `height`
/// pixels, row 0 at the greatest y, the outer corner of pixel (0, 0) at (left_m, top_m). Exact: the lines
/// are intersected with the triangles' planes. NaN if a line meets no triangle; edges belong to their
/// triangles. Triangles that are seen edge-on, or have a vertex that is missing or not finite, are omitted.
/// Errors: interrupted.
Result<Raster<float>> heights_from_above(const Mesh& mesh, double left_m, double top_m, double pixel_m,
                                         int width, int height, const Work& work);

/// What of a sheet a relief does not show as it is: places steeper than the slope limit became ramps.
struct SheetRamps {
  /// Share of the sheet's area, seen from above, whose height changed by more than kFelt_m.
  double share = 0.0;
  /// Greatest change of height.
  double most_m = 0.0;
  /// Smaller changes are not felt.
  static constexpr double kFelt_m = 0.0002;
};

/// The relief of the part of a mesh that is visible from +z, in the scene frame's axes and metres. The mesh
/// is centred above the origin with its lowest point at z >= 0, so the relief lies at the mesh's place.
/// `ramps`, if not null, receives what the slope limit changed. Long
/// work: polls cancel. Errors: usage for options out of range, invalid_input for a mesh without an extent,
/// interrupted.
Result<models::Relief> relief_from_sheet(const Mesh& mesh, const SheetOptions& options, const Work& work,
                                         SheetRamps* ramps = nullptr);

}  // namespace palpable::sculpt
