// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/mapping/surface_map.hpp"

namespace palpable::vision {

/// How certain an expected pose is: standard deviations of its position, m, and turn, rad, by each axis; > 0.
struct PoseDeviation {
  double position_m = 0.02;
  double turn_rad = 0.02;
};

/// The defaults were chosen on simulated rooms.
struct AlignmentOptions {
  /// Readings used, spread over the picture: 100 … 100 000.
  int readings = 3000;
  /// 1 … 100.
  int iterations = 12;
  /// The number of independent readings that as many are worth: neighbours have the map's errors in common.
  double independent_readings = 1500.0;
  /// Below this share of readings near the map's surface the picture is not aligned.
  double least_matched = 0.25;
};

struct AlignedPose {
  Transform<WorldFrame, CameraFrame> world_from_camera;
  /// Share of the readings that lie near the map's surface.
  double matched = 0.0;
  /// Whether the pose was found; otherwise it is the expected one.
  bool found = false;
};

/// The camera's pose at which a picture's points lie on the map's surfaces: Gauss-Newton on the map's
/// distances (Bylow et al. 2013), each weighted by its noise, robustly, together with the expected pose,
/// which decides where the surfaces leave a direction open (a bare wall). `expected` is the pose of `frame`.
AlignedPose aligned(const SurfaceMap& map, const PosedDepth& frame, const PoseDeviation& deviation,
                    const AlignmentOptions& options = {});

}  // namespace palpable::vision
