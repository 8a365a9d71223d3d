// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/depth_camera/steady_depth.hpp"

#include "palpable/core/picture/camera.hpp"
#include "palpable/vision/depth_camera/clean_depth.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {
namespace {

/// The changes of 5 x 5 pixels around it, each second one, show whether a surface moves. At least so many
/// must have changed alike: by as much as the pixel, within the noise of two means of 3 x 3 (clean_depth()).
constexpr int kAround = 4, kApart = 2, kLeast = 10;
constexpr float kAlike = 1.5F;
/// A mean change of less than so many standard deviations of a reading is noise; one of so many is a
/// movement. A surface that moved farther is a new one.
constexpr float kStill = 0.5F, kMoved = 0.8F, kFarthest = 6.0F;

}  // namespace

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
  const Raster<float> moved_m = movements_m(depth_m);
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
    mean += moved_m.values()[i];
    // False for an unknown mean.
    const bool is_same = std::abs(z - mean) <= kSameSurface * options_.noise.deviation_m(z);
    weight = is_same ? std::min(weight + 1.0F, most) : 1.0F;
    mean = is_same ? mean + (z - mean) / weight : z;
  }
  return mean_m_;
}

Raster<float> SteadyDepth::movements_m(const Raster<float>& depth_m) const {
  Raster<float> moved_m(depth_m.width(), depth_m.height());
  for (int y = 0; y < depth_m.height(); ++y)
    for (int x = 0; x < depth_m.width(); ++x) {
      const float change_m = depth_m(x, y) - mean_m_(x, y);
      const float deviation_m = options_.noise.deviation_m(depth_m(x, y));
      // False for an unknown depth.
      if (std::abs(change_m) <= kFarthest * deviation_m)
        moved_m(x, y) = movement_m(depth_m, x, y, change_m, deviation_m);
    }
  return moved_m;
}

float SteadyDepth::movement_m(const Raster<float>& depth_m, int x, int y, float change_m,
                              float deviation_m) const {
  float all_m = 0.0F, alike_m = 0.0F;
  int all = 0, alike = 0;
  for (int b = y - kAround; b <= y + kAround; b += kApart)
    for (int a = x - kAround; a <= x + kAround; a += kApart) {
      if (a < 0 || b < 0 || a >= depth_m.width() || b >= depth_m.height()) continue;
      const float other_m = depth_m(a, b) - mean_m_(a, b);
      // False for an unknown depth.
      if (!(std::abs(other_m) <= kFarthest * deviation_m)) continue;
      all_m += other_m, ++all;
      if (std::abs(other_m - change_m) <= kAlike * deviation_m) alike_m += other_m, ++alike;
    }
  if (alike < kLeast) return 0.0F;
  // An outlier of a surface at rest has others like it, but not the mean of all.
  const float sure = (std::abs(all_m / static_cast<float>(all)) / deviation_m - kStill) / (kMoved - kStill);
  return std::clamp(sure, 0.0F, 1.0F) * alike_m / static_cast<float>(alike);
}

}  // namespace palpable::vision
