// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"

#include <string>
#include <vector>

namespace palpable::draw {

/// Points of a model and the positions of a camera, in axes x right, y to the back and z up, from above and
/// from the front side by side. `unit`: "mm", or "units" where the scale is unknown; values are in it.
struct CameraPathView {
  std::vector<Vec3> points;
  /// In the order of the video.
  std::vector<Vec3> cameras;
  std::string unit;
};
Figure camera_path_figure(CameraPathView view, const FigureTitle& title);

}  // namespace palpable::draw
