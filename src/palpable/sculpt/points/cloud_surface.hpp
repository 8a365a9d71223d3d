// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <vector>

namespace palpable::sculpt {

/// How points become a surface. Chosen on points of balls and boxes with noise.
struct CloudOptions {
  /// Cubes of the surface along the cloud's longest side, at most; never finer than the points. 8 … 4096.
  int resolution = 256;
  /// The distance to this neighbour gives the spacing of the points and the area that each represents.
  /// 3 … 100.
  int neighbours = 8;
  /// The tangent planes of the points within this radius are averaged, spacings. 1 … 20.
  double radius_spacings = 2.5;
  /// The mean needs this many points, and normals whose weighted mean is at least this long; else the winding
  /// number decides. 1 … 100; 0 … 1.
  int least_points = 3;
  double least_agreement = 0.3;
};

std::vector<Parameter> parameters_of(CloudOptions& options);

/// The closed surface through points with outward normals. Near points it is the zero of the mean of their
/// tangent planes (Shen et al. 2004), so the noise of several fused frames averages out; elsewhere holes are
/// closed by the points' winding number (Barill et al. 2018). At least 16 points, finite, with normals. Long
/// work: all threads, polls cancel. Errors: usage for options out of range; invalid_input for too few
/// points, points without normals or on one plane or line, and a cloud that encloses nothing; interrupted.
Result<Mesh> surface_of_cloud(const PointCloud& cloud, const CloudOptions& options, const Work& work);

}  // namespace palpable::sculpt
