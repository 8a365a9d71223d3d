// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/plane_mask.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace palpable::vision {
namespace {

/// For each region, the share of its known pixels that lie on the plane.
std::vector<double> shares_on_plane(const Regions& regions, const Raster<float>& disparity_px,
                                    const DisparityPlane& plane, double tolerance_px) {
  std::vector<double> on(regions.pixels.size()), known(regions.pixels.size());
  for (int y = 0; y < disparity_px.height(); ++y) {
    for (int x = 0; x < disparity_px.width(); ++x) {
      const double r = disparity_px(x, y) - plane.at(x, y);
      if (!std::isfinite(r)) continue;
      const auto region = static_cast<std::size_t>(regions.of_pixel(x, y));
      known[region] += 1.0;
      on[region] += std::abs(r) <= tolerance_px ? 1.0 : 0.0;
    }
  }
  for (std::size_t i = 0; i < on.size(); ++i) on[i] = known[i] > 0.0 ? on[i] / known[i] : 0.0;
  return on;
}

/// A line fitted to a neighbourhood's distances from the plane.
struct PlaneFit {
  /// Mean distance, pixels of disparity; infinite where nothing is known.
  double distance_px = std::numeric_limits<double>::infinity();
  /// Change of the distance per row downwards.
  double slope = 0.0;
};

/// Uses the neighbours of the same region within `near_px` of the plane, so that matching noise averages out
/// and objects do not distort the mean.
PlaneFit fit_around(int x, int y, const Regions& regions, const Raster<float>& disparity_px,
                    const DisparityPlane& plane, int reach, double near_px) {
  double n = 0.0, sv = 0.0, sr = 0.0, svv = 0.0, svr = 0.0;
  for (int v = std::max(0, y - reach); v <= std::min(disparity_px.height() - 1, y + reach); ++v) {
    for (int u = std::max(0, x - reach); u <= std::min(disparity_px.width() - 1, x + reach); ++u) {
      const double distance = disparity_px(u, v) - plane.at(u, v);
      if (!(std::abs(distance) <= near_px) || regions.of_pixel(u, v) != regions.of_pixel(x, y)) continue;
      const double r = distance, row = v - y;
      n += 1.0;
      sv += row;
      sr += r;
      svv += row * row;
      svr += row * r;
    }
  }
  if (n < 1.0) return {};
  const double spread = n * svv - sv * sv;
  return {sr / n, spread > 0.0 ? (n * svr - sv * sr) / spread : 0.0};
}

}  // namespace

Raster<std::uint8_t> plane_mask(const Regions& regions, const Raster<float>& disparity_px,
                                const GroundPlane& fit, PlaneDirection direction,
                                const GroundMaskOptions& options, const Work& work) {
  const double tolerance_px = std::max(options.sigmas * fit.sigma_px, options.least_tolerance_px);
  const double near_px = std::max(options.near_tolerances * tolerance_px, options.least_near_px);
  const double rises = direction == PlaneDirection::ground ? -options.most_rise_share * fit.plane.b
                                                           : -std::numeric_limits<double>::infinity();
  const auto shares =
      shares_on_plane(regions, disparity_px, fit.plane,
                      std::max(1.5 * options.sigmas * fit.sigma_px, options.least_tolerance_px));
  Raster<std::uint8_t> mask(disparity_px.width(), disparity_px.height());
  parallel_for(work, mask.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      for (int x = 0; x < mask.width(); ++x) {
        const bool mostly = shares[static_cast<std::size_t>(regions.of_pixel(x, y))] > options.mostly_share;
        const PlaneFit around =
            fit_around(x, y, regions, disparity_px, fit.plane, options.neighbourhood_px, near_px);
        const double own = std::abs(disparity_px(x, y) - fit.plane.at(x, y));
        const double distance = std::abs(around.distance_px);
        const bool along = distance <= tolerance_px && around.slope > rises && !(own > near_px);
        mask(x, y) = along || (mostly && !(own > options.far_px) &&
                               !(std::isfinite(distance) && distance > 2.0 * tolerance_px))
                         ? 255
                         : 0;
      }
    }
  });
  return majority(mask, options.majority_px);
}

Raster<std::uint8_t> majority(const Raster<std::uint8_t>& mask, int reach) {
  Raster<std::uint8_t> out(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      int ground = 0, all = 0;
      for (int v = std::max(0, y - reach); v <= std::min(mask.height() - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(mask.width() - 1, x + reach); ++u) {
          ground += mask(u, v) != 0 ? 1 : 0;
          ++all;
        }
      }
      out(x, y) = 2 * ground > all ? 255 : 0;
    }
  }
  return out;
}

}  // namespace palpable::vision
