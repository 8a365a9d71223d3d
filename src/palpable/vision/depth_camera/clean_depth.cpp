// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/depth_camera/clean_depth.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/picture/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace palpable::vision {
namespace {

bool on_one_surface(float a_m, float b_m, const DepthNoise& noise) {
  return std::abs(a_m - b_m) <= kSameSurface * noise.deviation_m(std::max(a_m, b_m));
}

/// The mean of the readings on the surface of the median; sorts them.
float surface_mean(std::vector<float>& readings_m, const DepthNoise& noise) {
  if (readings_m.empty()) return kUnknownDepth;
  const auto [nearest, farthest] = std::minmax_element(readings_m.begin(), readings_m.end());
  // Where all are on one surface, the median need not be known.
  if (*farthest - *nearest <= kSameSurface * noise.deviation_m(*nearest))
    return std::accumulate(readings_m.begin(), readings_m.end(), 0.0F) /
           static_cast<float>(readings_m.size());
  const auto middle = readings_m.begin() + static_cast<std::ptrdiff_t>((readings_m.size() - 1) / 2);
  std::nth_element(readings_m.begin(), middle, readings_m.end());
  const float median_m = *middle;
  float sum_m = 0.0F;
  int count = 0;
  for (const float z : readings_m)
    if (on_one_surface(z, median_m, noise)) sum_m += z, ++count;
  return sum_m / static_cast<float>(count);
}

/// A flying pixel is farther from both surfaces than noise can explain in a picture of half a million pixels.
constexpr float kBetween = 6.0F;

/// Whether z lies between two surfaces and on neither. Comparisons with unknown readings are false.
bool flies_between(float z_m, float before_m, float after_m, const DepthNoise& noise) {
  const float near_m = std::min(before_m, after_m);
  const float far_m = std::max(before_m, after_m);
  const float apart_m = kBetween * noise.deviation_m(far_m);
  return z_m - near_m > apart_m && far_m - z_m > apart_m;
}

bool is_flying(const Raster<float>& depth_m, int x, int y, const DepthNoise& noise) {
  const float z = depth_m(x, y);
  const bool inside_x = x > 0 && x + 1 < depth_m.width();
  const bool inside_y = y > 0 && y + 1 < depth_m.height();
  return (inside_x && flies_between(z, depth_m(x - 1, y), depth_m(x + 1, y), noise)) ||
         (inside_y && flies_between(z, depth_m(x, y - 1), depth_m(x, y + 1), noise));
}

float mean_around(const Raster<float>& depth_m, int x, int y, const DepthNoise& noise) {
  const float z = depth_m(x, y);
  if (!std::isfinite(z)) return kUnknownDepth;
  const float apart_m = kSameSurface * noise.deviation_m(z);
  float sum_m = 0.0F;
  float count = 0.0F;
  for (int b = std::max(0, y - 1); b <= std::min(depth_m.height() - 1, y + 1); ++b)
    for (int a = std::max(0, x - 1); a <= std::min(depth_m.width() - 1, x + 1); ++a) {
      const float other = depth_m(a, b);
      // False for an unknown reading.
      if (std::abs(other - z) <= apart_m) sum_m += other, count += 1.0F;
    }
  return sum_m / count;
}

}  // namespace

Result<void> check(const DepthNoise& noise) {
  for (const double part : {noise.floor_m, noise.per_m2})
    if (!(part >= 0.0 && part <= 0.1))
      return Error{ErrorCode::usage, "the depth camera's noise must be 0 to 0.1", {}};
  return {};
}

Raster<float> reduced_depth(const Raster<float>& depth_m, int k, const DepthNoise& noise) {
  PALPABLE_CHECK(k >= 1);
  if (k == 1) return depth_m;
  Raster<float> reduced((depth_m.width() + k - 1) / k, (depth_m.height() + k - 1) / k);
  std::vector<float> readings_m;
  readings_m.reserve(static_cast<std::size_t>(k) * static_cast<std::size_t>(k));
  for (int y = 0; y < reduced.height(); ++y)
    for (int x = 0; x < reduced.width(); ++x) {
      readings_m.clear();
      for (int b = y * k; b < std::min((y + 1) * k, depth_m.height()); ++b)
        for (int a = x * k; a < std::min((x + 1) * k, depth_m.width()); ++a)
          if (std::isfinite(depth_m(a, b))) readings_m.push_back(depth_m(a, b));
      reduced(x, y) = surface_mean(readings_m, noise);
    }
  return reduced;
}

Raster<float> clean_depth(const Raster<float>& depth_m, const DepthNoise& noise) {
  Raster<float> kept(depth_m.width(), depth_m.height());
  for (int y = 0; y < kept.height(); ++y)
    for (int x = 0; x < kept.width(); ++x)
      kept(x, y) = is_flying(depth_m, x, y, noise) ? kUnknownDepth : depth_m(x, y);
  Raster<float> cleaned(kept.width(), kept.height());
  for (int y = 0; y < cleaned.height(); ++y)
    for (int x = 0; x < cleaned.width(); ++x) cleaned(x, y) = mean_around(kept, x, y, noise);
  return cleaned;
}

}  // namespace palpable::vision
