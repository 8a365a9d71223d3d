// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/open_options.hpp"
#include "palpable/models/scene/scene.hpp"

#include <cstddef>

namespace palpable::session {

struct StrokeOptions {
  /// Rows or columns in which the longer side of the scene is searched, 2 ... 1000.
  int lines = 48;
  /// Places that rise at least this part of the scene's depth above its lowest point belong to the solid, 0
  /// ... 1.
  double raised = 0.05;
  /// A stroke ends where the surface is steeper in any direction, m/m, above 0. If it is so everywhere, up to
  /// eight times as much is allowed.
  double steepest = 0.7;
  /// A stroke has at least this part of the longest stroke's number of points, 0 ... 1.
  double shortest = 0.5;
};

/// Strokes for a simulated hand along the surface of a solid (field or grid) as it is seen from above: along
/// rows and columns, where neighbouring places belong to the solid and are not too steep; the longest first.
/// At least one for a solid. None for reliefs and contours, which are felt at every place. Any thread.
device::SurfaceStrokes strokes_along_solid(const models::Scene& scene,
                                           const Transform<SceneFrame, DeviceFrame>& scene_from_device,
                                           const StrokeOptions& options = {});

}  // namespace palpable::session
