// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/models/contours/boundary_map.hpp"
#include "palpable/vision/contours/contours.hpp"

namespace palpable::sculpt {

struct BoundaryMapOptions {
  /// Rectangle that the picture is fitted into, keeping its aspect ratio. Each 0.001 … 1 m.
  double width_m = 0.10;
  double height_m = 0.10;
  /// Radius m of the neighbourhood of eq. 7, 1 … 32 px.
  double radius_px = 3.0;
};

/// The boundaries that vision found, as a map in the scene's plane: directions turned from image axes (y
/// down) to the scene's (y up). Errors: as BoundaryMap::from_edges().
Result<models::BoundaryMap> boundary_map_from_contours(const vision::ContourMap& contours,
                                                       const BoundaryMapOptions& options, const Work& work);

/// Unit tangents in image axes (y down) and strengths of a boundary map's pixels.
struct TangentMap {
  Raster<float> x;
  Raster<float> y;
  Raster<float> strength;
};
TangentMap tangents_of(const Raster<models::BoundaryPixel>& pixels);

/// One-pixel-wide lines of a map's edges: their strength on ridges of lines that reach the map's threshold, 0
/// elsewhere (vision::ridge_lines).
Raster<float> boundary_lines(const models::BoundaryMap& map, const vision::LineOptions& options = {},
                             const Work& work = {});

}  // namespace palpable::sculpt
