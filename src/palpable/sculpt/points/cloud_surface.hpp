// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/point_cloud.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

namespace palpable::sculpt {

struct CloudOptions {
  /// Cubes of the surface along the cloud's longest side, at most; never finer than the points.
  int resolution = 256;
};

/// The closed surface of the solid that points with outward normals lie on. Near points it is where the mean
/// of their tangent planes is 0 (Shen et al. 2004), so noise of several fused frames averages out; where
/// there are none, holes are closed as the points' winding number says (Barill et al. 2018). At least 16
/// points, finite, with normals. Long work: all threads, polls cancel. Errors: invalid_input for too few
/// points, points without normals or on one plane or line, and a cloud that encloses nothing; interrupted.
Result<Mesh> surface_of_cloud(const PointCloud& cloud, const CloudOptions& options, const Work& work);

}  // namespace palpable::sculpt
