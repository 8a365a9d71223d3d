// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/lens_camera.hpp"

#include <cmath>
#include <numbers>

namespace palpable::vision {

LensCamera usual_camera(int width, int height) {
  const double focal_px = 0.5 * width / std::tan(0.5 * kUsualFieldOfView_deg * std::numbers::pi / 180.0);
  return {{focal_px, 0, 0.5 * (width - 1), 0, focal_px, 0.5 * (height - 1), 0, 0, 1}, {}};
}

}  // namespace palpable::vision
