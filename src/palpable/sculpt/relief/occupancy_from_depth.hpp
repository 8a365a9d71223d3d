// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/grid/occupancy_grid.hpp"
#include "palpable/models/relief/relief.hpp"

#include <span>

namespace palpable::sculpt {

struct OccupancyOptions {
  /// Points along the longest side of the box, 8 ... 512.
  int resolution = 160;
};

/// The volume between a relief and its base z = 0 as a lattice of points: a depth map seen from above,
/// filled away from the camera (Park & Howard 2012). Errors: usage for the resolution.
Result<models::Occupancy> occupancy_from_relief(const models::Relief& relief,
                                                const OccupancyOptions& options);

/// A depth map and where its camera stands.
struct DepthView {
  const DepthMap* depth = nullptr;
  Transform<SceneFrame, CameraFrame> scene_from_camera;
};

/// The volume behind the surfaces of one or several depth maps, inside the box least_m … most_m. A point is
/// occupied if some map has a surface in front of it (at most `fill_m` in front, if that is above 0) and no
/// map sees through it. Errors: usage for the resolution or an empty box; invalid_input for a map without a
/// camera, or of another size than it.
struct VolumeBox {
  Vec3 least_m;
  Vec3 most_m;
  double fill_m = 0.0;
};
Result<models::Occupancy> occupancy_from_depth(std::span<const DepthView> views, const VolumeBox& box,
                                               const OccupancyOptions& options, const Work& work);

}  // namespace palpable::sculpt
