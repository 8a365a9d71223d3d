// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/mapping/surface_map.hpp"

namespace palpable::vision {

/// What a camera would see of a map.
struct MapView {
  /// Along the camera's z axis, metres; NaN = nothing is known.
  Raster<float> depth_m;
  /// When that was seen last, on the map's clock; undefined where the depth is unknown.
  Raster<float> seen_s;
};

/// Which pixels of a view are asked for: those where this is not finite; an empty raster asks for all.
using Known = Raster<float>;

/// Follows each pixel's ray to the first surface that is seen from its outside, up to the map's far_m.
MapView view_of(const SurfaceMap& map, const Transform<WorldFrame, CameraFrame>& world_from_camera,
                const Pinhole& camera, const Known& known = {});

}  // namespace palpable::vision
