// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/label_outline.hpp"

namespace palpable::sculpt {

std::vector<LineOfSight> outline_of(const Raster<std::uint8_t>& labels, std::uint8_t label,
                                    const Pinhole& camera,
                                    const Transform<SceneFrame, CameraFrame>& scene_from_camera) {
  std::vector<LineOfSight> sights;
  const Vec3 eye = (scene_from_camera * Point<CameraFrame>{}).v;
  const auto add = [&](double x, double y) {
    const Vec3 along{(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0};
    sights.push_back({eye, unit(scene_from_camera.rotate(along))});
  };
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const bool here = labels(x, y) == label;
      if (x + 1 < labels.width() && here != (labels(x + 1, y) == label)) add(x + 0.5, y);
      if (y + 1 < labels.height() && here != (labels(x, y + 1) == label)) add(x, y + 0.5);
    }
  return sights;
}

}  // namespace palpable::sculpt
