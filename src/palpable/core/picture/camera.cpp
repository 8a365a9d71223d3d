// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/camera.hpp"

#include <limits>

namespace palpable {

std::optional<DepthMap> depth_from_disparity(const DisparityMap& disparity) {
  if (!disparity.rig) return std::nullopt;
  const StereoRig& rig = *disparity.rig;
  const auto& px = disparity.disparity_px;
  DepthMap out{Raster<float>(px.width(), px.height(), std::numeric_limits<float>::quiet_NaN()), rig.left};
  for (int y = 0; y < px.height(); ++y) {
    for (int x = 0; x < px.width(); ++x) {
      const double d = static_cast<double>(px(x, y)) + rig.doffs_px;
      if (d > 0.0) out.depth_m(x, y) = static_cast<float>(rig.baseline_m * rig.left.fx / d);
    }
  }
  return out;
}

}  // namespace palpable
