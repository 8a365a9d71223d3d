// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/depth_camera/steady_depth.hpp"

#include "palpable/core/picture/camera.hpp"
#include "palpable/vision/depth_camera/clean_depth.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {

Result<void> check(const SteadyDepthOptions& options) {
  if (options.frames < 1 || options.frames > 1000)
    return Error{ErrorCode::usage, "depth is averaged over 1 to 1000 frames", {}};
  if (!(options.hold_s >= 0.0 && options.hold_s <= 60.0))
    return Error{ErrorCode::usage, "lost depth is held for 0 to 60 s", {}};
  return check(options.noise);
}

const Raster<float>& SteadyDepth::add(const Raster<float>& depth_m, double dt_s) {
  if (mean_m_.width() != depth_m.width() || mean_m_.height() != depth_m.height()) {
    mean_m_ = Raster<float>(depth_m.width(), depth_m.height(), kUnknownDepth);
    weight_ = Raster<float>(depth_m.width(), depth_m.height());
    age_s_ = Raster<float>(depth_m.width(), depth_m.height());
  }
  const auto most = static_cast<float>(options_.frames);
  const auto hold_s = static_cast<float>(options_.hold_s);
  for (std::size_t i = 0; i < depth_m.count(); ++i) {
    const float z = depth_m.values()[i];
    float& mean = mean_m_.values()[i];
    float& weight = weight_.values()[i];
    float& age_s = age_s_.values()[i];
    if (!std::isfinite(z)) {
      age_s += static_cast<float>(dt_s);
      if (age_s > hold_s) mean = kUnknownDepth;
      continue;
    }
    age_s = 0.0F;
    // False for an unknown mean.
    const bool is_same = std::abs(z - mean) <= kSameSurface * options_.noise.deviation_m(z);
    weight = is_same ? std::min(weight + 1.0F, most) : 1.0F;
    mean = is_same ? mean + (z - mean) / weight : z;
  }
  return mean_m_;
}

}  // namespace palpable::vision
