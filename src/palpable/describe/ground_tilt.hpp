// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <optional>

namespace palpable::describe {

/// A level or tilted plane: z = z_m + dzdx * x + dzdy * y, scene frame, metres.
struct GroundPlane {
  double z_m = 0.0;
  double dzdx = 0.0;
  double dzdy = 0.0;

  double height_m(double x_m, double y_m) const { return z_m + dzdx * x_m + dzdy * y_m; }
};

/// When a plane is the ground that objects stand on. Shares are 0 ... 1.
struct GroundTiltOptions {
  /// Least share of the places that lie on it.
  double least_share = 0.4;
  /// Greatest share of the places that lie below it: a roof's side is no ground.
  double most_below = 0.1;
  /// Distance within which a place lies on it, as a share of the surface's height range.
  double tolerance = 0.02;
};

/// The plane that most places of a height grid lie on, if it is the ground; nullopt if there is none. The
/// middle of the grid is the origin, its first row is the upper one; cells are cell_x_m x cell_y_m. Always
/// the same for the same grid (planes through fixed triples of places; the best is refined by least squares).
std::optional<GroundPlane> ground_plane_of(const Raster<float>& height_m, double cell_x_m, double cell_y_m,
                                           const GroundTiltOptions& options = {});

}  // namespace palpable::describe
