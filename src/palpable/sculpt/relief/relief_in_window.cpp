// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/relief_in_window.hpp"

#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::sculpt {
namespace {

Result<void> check_windowed(const vision::DepthRange& range, const WindowedReliefOptions& options) {
  if (auto valid = check_relief_shape(options.size_m, options.steepest_slope); !valid) return valid;
  if (!(range.near_m > 0.0 && range.far_m > range.near_m && std::isfinite(range.far_m)))
    return Error{
        ErrorCode::usage, "the depth window must begin in front of the camera and end farther away", {}};
  return {};
}

}  // namespace

Result<models::Relief> relief_in_window(const Raster<float>& depth_m, const vision::DepthRange& range,
                                        const WindowedReliefOptions& options) {
  if (auto valid = check_windowed(range, options); !valid) return std::move(valid).error();
  if (depth_m.width() < 2 || depth_m.height() < 2)
    return invalid_input("a relief needs at least 2 x 2 pixels");
  const Vec3 size = options.size_m;
  const double pixel_m = std::min(size.x / depth_m.width(), size.y / depth_m.height());
  const auto rise = static_cast<float>(size.z / (range.far_m - range.near_m));
  const auto near_m = static_cast<float>(range.near_m);
  const auto far_m = static_cast<float>(range.far_m);
  Raster<float> height_m(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < depth_m.count(); ++i) {
    const float z = depth_m.values()[i];
    height_m.values()[i] = std::isfinite(z) ? rise * (far_m - std::clamp(z, near_m, far_m)) : 0.0F;
  }
  models::cut_to_slope(height_m, pixel_m, options.steepest_slope);
  return models::Relief::from_samples(std::move(height_m), pixel_m);
}

}  // namespace palpable::sculpt
