// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/fast.hpp"

#include "palpable/vision/census.hpp"
#include "palpable/vision/consistency.hpp"
#include "palpable/vision/left_right.hpp"
#include "palpable/vision/median.hpp"
#include "palpable/vision/sgm.hpp"

namespace palpable::vision {

Result<MatchOutput> match_fast(const MatchInput& input, const StereoOptions&, const Work& work) {
  const int w = input.left.width();
  const int h = input.left.height();
  const MatchView left{colour_planes(input.left), census_9x7(input.left_grey, work)};
  const MatchView right{colour_planes(input.right), census_9x7(input.right_grey, work)};
  CostVolume costs(w, h, input.disparities);
  CostVolume sums(w, h, input.disparities);
  pixel_costs(left, right, costs, work);
  average_over_crosses(left.colour, costs, sums, work);
  if (work.cancelled()) return Work::interrupted();
  aggregate_paths(costs, left.colour, right.colour, sums, work);
  if (work.cancelled()) return Work::interrupted();

  MatchOutput out;
  out.disparity_px = least_cost_disparity(sums, work);
  out.confidence = agreement(out.disparity_px, least_cost_disparity_of_other(sums, work));
  Raster<std::uint8_t> trusted(w, h);
  for (std::size_t i = 0; i < trusted.count(); ++i) trusted.values()[i] = out.confidence.values()[i] > 0.0F;
  fill_from_behind(trusted, out.disparity_px);
  // Twice: specks of a few pixels go too, and corners stay sharper than under one wide median.
  for (int pass = 0; pass < 2; ++pass) out.disparity_px = median_3x3(out.disparity_px, work);
  return out;
}

}  // namespace palpable::vision
