// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/relief_in_window.hpp"

#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::sculpt {
namespace {

Result<void> check_windowed(const DepthWindow& window, const WindowedReliefOptions& options) {
  const auto usage = [](const char* message) { return Error{ErrorCode::usage, message, {}}; };
  const Vec3 s = options.size_m;
  for (const double side : {s.x, s.y, s.z})
    if (!(side >= 0.001 && side <= 1.0)) return usage("the size's sides must be 1 to 1000 mm");
  if (!(options.steepest_slope >= 0.1 && options.steepest_slope <= 100.0))
    return usage("the steepest slope must be 0.1 to 100");
  if (!(window.near_m > 0.0 && window.far_m > window.near_m && std::isfinite(window.far_m)))
    return usage("the depth window must begin in front of the camera and end farther away");
  return {};
}

}  // namespace

Result<models::Relief> relief_in_window(const Raster<float>& depth_m, const DepthWindow& window,
                                        const WindowedReliefOptions& options) {
  if (auto valid = check_windowed(window, options); !valid) return std::move(valid).error();
  if (depth_m.width() < 2 || depth_m.height() < 2)
    return invalid_input("a relief needs at least 2 x 2 pixels");
  const Vec3 size = options.size_m;
  const double pixel_m = std::min(size.x / depth_m.width(), size.y / depth_m.height());
  const auto rise = static_cast<float>(size.z / (window.far_m - window.near_m));
  const auto near_m = static_cast<float>(window.near_m);
  const auto far_m = static_cast<float>(window.far_m);
  Raster<float> height_m(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < depth_m.count(); ++i) {
    const float z = depth_m.values()[i];
    height_m.values()[i] = std::isfinite(z) ? rise * (far_m - std::clamp(z, near_m, far_m)) : 0.0F;
  }
  models::cut_to_slope(height_m, pixel_m, options.steepest_slope);
  return models::Relief::from_samples(std::move(height_m), pixel_m);
}

}  // namespace palpable::sculpt
