// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/matching_cost.hpp"

#include "palpable/core/vectorize.hpp"
#include "palpable/vision/census.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace palpable::vision {
namespace {

/// The right picture's row reversed, so that x - d runs forward with d; its first column repeated at the end.
struct ReversedRow {
  std::vector<std::uint64_t> census;
  std::vector<std::uint8_t> r, g, b;
};

PALPABLE_VECTORIZE void pixel_costs(std::uint64_t census, std::uint64_t alike, Rgb8 colour,
                                    const std::uint64_t* right_census, const std::uint8_t* r,
                                    const std::uint8_t* g, const std::uint8_t* b, int count,
                                    const CostOptions& options, std::uint8_t* out) {
  const int limit = 3 * options.colour_limit;
  const int weight = options.colour_weight * 85;  // 85 / 256 is a third
  for (int d = 0; d < count; ++d) {
    const int difference = std::abs(colour.r - r[d]) + std::abs(colour.g - g[d]) + std::abs(colour.b - b[d]);
    out[d] = static_cast<std::uint8_t>(std::min(difference, limit) * weight / 256);
  }
  const int scale = options.census_weight * census_scale(alike);
  for (int d = 0; d < count; ++d) {
    const int cost = out[d] + scale * std::popcount((census ^ right_census[d]) & alike) / kCensusScaleUnit;
    out[d] = static_cast<std::uint8_t>(std::min(cost, 255));
  }
}

}  // namespace

MatchingCost::MatchingCost(const MatchInput& input, const CostOptions& options, const Work& work)
    : input_(input),
      options_(options),
      left_census_(census_9x7(input.left_grey, work)),
      left_alike_(alike_9x7(colour_planes(input.left), work)),
      right_census_(census_9x7(input.right_grey, work)) {}

void MatchingCost::fill_row(int y, std::uint8_t* out) const {
  const int width = input_.left.width();
  const int count = input_.disparities;
  const auto length = static_cast<std::size_t>(width) + static_cast<std::size_t>(count);
  thread_local ReversedRow row;
  row.census.resize(length);
  row.r.resize(length);
  row.g.resize(length);
  row.b.resize(length);
  for (std::size_t i = 0; i < length; ++i) {
    const int x = std::max(0, width - 1 - static_cast<int>(i));
    const Rgb8 colour = input_.right(x, y);
    row.census[i] = right_census_(x, y);
    row.r[i] = colour.r;
    row.g[i] = colour.g;
    row.b[i] = colour.b;
  }
  for (int x = 0; x < width; ++x) {
    const auto from = static_cast<std::size_t>(width - 1 - x);
    pixel_costs(left_census_(x, y), left_alike_(x, y), input_.left(x, y), row.census.data() + from,
                row.r.data() + from, row.g.data() + from, row.b.data() + from, count, options_,
                out + static_cast<std::size_t>(x) * static_cast<std::size_t>(count));
  }
}

}  // namespace palpable::vision
