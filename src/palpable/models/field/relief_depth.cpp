// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/relief_depth.hpp"

#include "palpable/models/relief/relief_dilation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::models {
namespace {

constexpr int kErosions = 6;

/// `rate` times the height above a surface.
FieldSample over(const HeightSample& surface, double z_m, double rate) {
  return {rate * (z_m - surface.z_m), {-rate * surface.dzdx, -rate * surface.dzdy, rate}};
}

}  // namespace

Result<ReliefDepth> ReliefDepth::under(std::shared_ptr<const Relief> relief, const Work& work) {
  ReliefDepth depth;
  depth.relief_ = std::move(relief);
  const double steepest = depth.relief_->steepest_slope();
  depth.steepest_rate_ = 1.0 / std::sqrt(1.0 + steepest * steepest);
  const Relief* above = depth.relief_.get();
  double depth_m = 0.0;
  depth.erosions_.reserve(kErosions);
  for (int k = 0; k < kErosions; ++k) {
    // Erosions by balls add up: each one starts from the previous one.
    const double further_m = above->pixel_m() * (k == 0 ? 1 : 1 << (k - 1));
    Raster<float> values = erode_by_ball(*above, further_m, work);
    // An erosion lowers the surface by at least the radius; so the spline must do so too.
    for (std::size_t i = 0; i < values.count(); ++i)
      values.data()[i] =
          std::min(values.data()[i], above->samples_m().data()[i] - static_cast<float>(further_m));
    auto surface = Relief::from_samples(std::move(values), above->pixel_m());
    if (!surface) return surface.error();
    depth_m += further_m;
    depth.erosions_.push_back({*std::move(surface), depth_m});
    above = &depth.erosions_.back().surface;
  }
  return depth;
}

FieldSample ReliefDepth::sample(Point<SceneFrame> place) const noexcept {
  const Vec3 place_m = place.v;
  HeightSample upper = relief_->sample(place_m.x, place_m.y);
  if (place_m.z >= upper.z_m) return over(upper, place_m.z, steepest_rate_);
  double upper_depth_m = 0.0;
  for (const Erosion& erosion : erosions_) {
    const HeightSample lower = erosion.surface.sample(place_m.x, place_m.y);
    if (place_m.z < lower.z_m) {
      upper = lower;
      upper_depth_m = erosion.depth_m;
      continue;
    }
    const double rate = (erosion.depth_m - upper_depth_m) / (upper.z_m - lower.z_m);
    const double share = (upper.z_m - place_m.z) / (upper.z_m - lower.z_m);
    const double dzdx = upper.dzdx + share * (lower.dzdx - upper.dzdx);
    const double dzdy = upper.dzdy + share * (lower.dzdy - upper.dzdy);
    return {-(upper_depth_m + rate * (upper.z_m - place_m.z)), {-rate * dzdx, -rate * dzdy, rate}};
  }
  FieldSample deeper = over(upper, place_m.z, steepest_rate_);
  deeper.distance_m -= upper_depth_m;
  return deeper;
}

std::size_t ReliefDepth::memory_bytes() const {
  std::size_t bytes = sizeof(*this);
  each_surface([&](const Relief& surface) { bytes += surface.memory_bytes(); });
  return bytes;
}

}  // namespace palpable::models
