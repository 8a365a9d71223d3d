// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"

namespace palpable::vision {

/// The plane through one reading. The inverse depth of a plane is linear across the picture, 1/m.
struct PixelPlane {
  /// At the pixel's centre, and its derivatives by x and y, px; `inverse` 0 = unknown.
  float inverse = 0.0F, by_x = 0.0F, by_y = 0.0F;
  /// The distance of a point from the plane over the difference of their depths on one ray, > 0 … about 1:
  /// small for a surface that is seen along its edge.
  float facing = 0.0F;
};

/// The plane at each pixel. Its slopes are differences over two pixels on the flatter side, so that edges do
/// not count; a reading without a neighbour there is unknown.
Raster<PixelPlane> pixel_planes(const Raster<float>& depth_m, const Pinhole& camera);

}  // namespace palpable::vision
