// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/depth_camera/depth_range.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpable::vision {
namespace {

/// Every third pixel of every third row is enough for percentiles.
std::vector<float> some_known(const Raster<float>& depth_m) {
  constexpr int kStep = 3;
  std::vector<float> known;
  for (int y = 0; y < depth_m.height(); y += kStep)
    for (int x = 0; x < depth_m.width(); x += kStep)
      if (std::isfinite(depth_m(x, y))) known.push_back(depth_m(x, y));
  return known;
}

std::optional<DepthRange> range_of_known(std::vector<float>& known) {
  if (known.empty()) return std::nullopt;
  const auto at = [&](double share) {
    const auto k = known.begin() + std::lround(share * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), k, known.end());
    return static_cast<double>(*k);
  };
  constexpr double kOutliers = 0.01;
  constexpr double kLeast_m = 0.01;
  const double near_m = at(kOutliers);
  const double far_m = at(1.0 - kOutliers);
  const double beyond_m = 0.1 * std::max(far_m - near_m, kLeast_m / 1.2);
  return DepthRange{std::max(near_m - beyond_m, 0.5 * near_m),
                    std::max(far_m, near_m + kLeast_m / 1.2) + beyond_m};
}

double share_outside(const std::vector<float>& known, const DepthRange& range) {
  const auto outside = std::count_if(known.begin(), known.end(), [&](float z) {
    return static_cast<double>(z) < range.near_m || static_cast<double>(z) > range.far_m;
  });
  return static_cast<double>(outside) / static_cast<double>(known.size());
}

}  // namespace

std::optional<DepthRange> range_of_depths(const Raster<float>& depth_m) {
  auto known = some_known(depth_m);
  return range_of_known(known);
}

std::optional<DepthRange> FollowedRange::add(const Raster<float>& depth_m, double dt_s) {
  auto known = some_known(depth_m);
  const auto seen = range_of_known(known);
  if (!seen) return range_;
  if (!range_) return range_ = seen;
  constexpr double kMostOutside = 0.05;
  constexpr double kLeastFilled = 1.0 / 3.0;
  constexpr double kSpeed_per_s = 0.2;
  const double width_m = range_->far_m - range_->near_m;
  const bool is_suited =
      share_outside(known, *range_) <= kMostOutside && seen->far_m - seen->near_m >= kLeastFilled * width_m;
  unsuited_s_ = is_suited ? 0.0 : unsuited_s_ + dt_s;
  if (unsuited_s_ < patience_s_) return range_;
  const double step_m = kSpeed_per_s * width_m * dt_s;
  range_->near_m += std::clamp(seen->near_m - range_->near_m, -step_m, step_m);
  range_->far_m += std::clamp(seen->far_m - range_->far_m, -step_m, step_m);
  return range_;
}

}  // namespace palpable::vision
