// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/heights_above_ground.hpp"

#include "palpable/core/check.hpp"
#include "palpable/vision/segmentation/ground_plane.hpp"

#include <algorithm>

namespace palpable::sculpt {

std::vector<Parameter> parameters_of(FlattenOptions& o) {
  return {{"least_share", &o.least_share, {0, 1}, "", "share of samples on the ground"},
          {"most_under_share", &o.most_under_share, {0, 1}, "", "share of samples under it"},
          {"tolerance_share", &o.tolerance_share, {0.001, 0.5}, "", "tolerance over the relief's height"}};
}

std::optional<Raster<float>> heights_above_ground(const models::Relief& relief, const Work& work,
                                                  const FlattenOptions& options) {
  PALPABLE_CHECK(check_ranges(options));
  const double range_m = relief.highest_m() - relief.lowest_m();
  if (!(range_m > 0.0)) return std::nullopt;
  // The finder's tolerances are pixels of disparity: its inlier tolerance is made the tolerance here.
  const vision::GroundPlaneOptions search;
  const double unit_m = options.tolerance_share * range_m / search.tolerance_px;
  Raster<float> scaled = relief.samples_m();
  for (float& z : scaled.values()) z = static_cast<float>(static_cast<double>(z) / unit_m);
  const auto found = vision::find_back_plane(scaled, work, search);
  if (!found) return std::nullopt;
  double on = 0.0, under = 0.0;
  for (int y = 0; y < scaled.height(); ++y)
    for (int x = 0; x < scaled.width(); ++x) {
      const double above = scaled(x, y) - found->plane.at(x, y);
      on += std::abs(above) <= search.tolerance_px ? 1.0 : 0.0;
      under += above < -2.0 * search.tolerance_px ? 1.0 : 0.0;
      scaled(x, y) = static_cast<float>(std::max(0.0, above * unit_m));
    }
  const auto all = static_cast<double>(scaled.count());
  if (on < options.least_share * all || under > options.most_under_share * all) return std::nullopt;
  return scaled;
}

}  // namespace palpable::sculpt
