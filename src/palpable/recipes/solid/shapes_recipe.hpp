// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/superquadric/superquadric_set.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::recipes {

/// Points on the surfaces of a scene, and where they were seen from.
struct SeenPoints {
  std::vector<Vec3> points_m;
  /// Object of each point, 1 … 255; empty if objects are not distinguished.
  std::vector<std::uint8_t> labels;
  /// The camera, where there was one.
  std::optional<Point<SceneFrame>> camera;
};

struct FittedShapes {
  sculpt::ShapeSet set;
  /// Number of points in the input.
  std::size_t points = 0;
};

/// The points of a depth map's pixels. The camera is at the origin and looks along -z, y up. `labels`:
/// empty, or of the map's size; pixels of label 0 are omitted, objects of different labels share no shape.
/// Errors: invalid_input with Reason::needs_calibration for a map without its camera, and for labels of
/// another size.
Result<SeenPoints> points_of_depth(const DepthMap& depth, const std::optional<Raster<float>>& labels);

/// Points all over the surface of the solid that a mesh encloses, which is repaired as for a field, in the
/// mesh's coordinates. Long work. Errors: as solid_of() and sampled_surface().
Result<SeenPoints> points_of_mesh(Mesh mesh, const Work& work);

/// Superquadrics fitted to points (sculpt::fit_superquadrics()). Long work, any thread. Errors: as there.
Result<FittedShapes> shapes_from_points(const SeenPoints& seen, const sculpt::ShapeSetOptions& options,
                                        const Work& work);

}  // namespace palpable::recipes
