// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/matching_cost.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <numeric>

namespace palpable::vision {
namespace {

[[gnu::always_inline]] inline std::uint8_t apart(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>(a > b ? a - b : b - a);
}

struct PixelRow {
  const std::uint64_t *census, *similar;
  const std::uint8_t *r, *g, *b;
};

PALPABLE_VECTORIZE void compare(const PixelRow& here, const PixelRow& there, int width, int stride,
                                std::uint8_t* __restrict census, std::uint8_t* __restrict colour) {
  for (int x = 0; x < width; ++x) {
    const int first = width - 1 - x;
    const std::uint64_t signature = here.census[x];
    const std::uint64_t similar = here.similar[x];
    const std::uint64_t* __restrict other = there.census + first;
    for (int d = 0; d < stride; ++d)
      census[d] = static_cast<std::uint8_t>(__builtin_popcountll((signature ^ other[d]) & similar));
    const int scale = census_scale(similar);
    for (int d = 0; d < stride; ++d)
      census[d] = static_cast<std::uint8_t>(census[d] * scale / kCensusScaleUnit);
    const std::uint8_t* __restrict r = there.r + first;
    const std::uint8_t* __restrict g = there.g + first;
    const std::uint8_t* __restrict b = there.b + first;
    const std::uint8_t r0 = here.r[x];
    const std::uint8_t g0 = here.g[x];
    const std::uint8_t b0 = here.b[x];
    for (int d = 0; d < stride; ++d) {
      const std::uint8_t dr = apart(r0, r[d]);
      const std::uint8_t dg = apart(g0, g[d]);
      const std::uint8_t db = apart(b0, b[d]);
      const std::uint8_t most = dr > dg ? dr : dg;
      colour[d] = most > db ? most : db;
    }
    census += stride;
    colour += stride;
  }
}

PALPABLE_VECTORIZE void add_weighted(const std::uint8_t* __restrict colour, const CostOptions& options,
                                     std::size_t count, std::uint8_t* __restrict cost) {
  const int census_weight = options.census_weight;
  const int colour_weight = options.colour_weight;
  const int limit = options.colour_limit;
  const int halvings = options.halvings;
  for (std::size_t i = 0; i < count; ++i) {
    const int difference = colour[i] < limit ? colour[i] : limit;
    const int sum = (census_weight * cost[i] + colour_weight * difference) >> halvings;
    cost[i] = static_cast<std::uint8_t>(sum < kLargestMatchingCost ? sum : kLargestMatchingCost);
  }
}

/// Sets the costs of the disparities from `known` on, whose matches are outside the picture.
void fill_out_of_view(std::uint8_t* cost, int known, int stride, float share) {
  std::uint8_t neutral = 0;
  if (known > 0) {
    const float mean = static_cast<float>(std::accumulate(cost, cost + known, 0)) / static_cast<float>(known);
    const auto least = static_cast<float>(*std::min_element(cost, cost + known));
    neutral = static_cast<std::uint8_t>(least + share * (mean - least));
  }
  std::fill(cost + known, cost + stride, neutral);
}

}  // namespace

std::vector<Parameter> parameters_of(CostOptions& o) {
  std::vector<Parameter> all{
      {"census_weight", &o.census_weight, {0, 4}, "", "Weight of each census bit that differs"},
      {"colour_limit", &o.colour_limit, {1, 255}, "levels", "Truncation of the colour difference"},
      {"colour_weight", &o.colour_weight, {0, 8}, "", "Weight of each level of the colour difference"},
      {"halvings", &o.halvings, {0, 4}, "", "How often the sum of both is halved"},
      {"out_of_view",
       &o.out_of_view,
       {0, 1},
       "",
       "Cost of a match outside the picture: 0 = the pixel's least, 1 = its mean"}};
  append_parameters(all, "census", parameters_of(o.census));
  return all;
}

MatchView match_view(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& luma,
                     const CensusOptions& census, const Work& work) {
  MatchView view{colour_planes(picture), census_9x7(luma, work), {}};
  view.similar = similar_pixels_9x7(view.colour, census, work);
  return view;
}

void ReversedRow::assign(const MatchView& view, int y, int more) {
  const auto reverse = [&](auto row, auto& out) {
    out.assign(row.rbegin(), row.rend());
    out.insert(out.end(), static_cast<std::size_t>(more), row.front());
  };
  reverse(view.census.row(y), census);
  reverse(view.colour.r.row(y), r);
  reverse(view.colour.g.row(y), g);
  reverse(view.colour.b.row(y), b);
}

void compare_row(const MatchView& view, int y, const ReversedRow& there, int stride, std::uint8_t* census,
                 std::uint8_t* colour) {
  compare({view.census.row(y).data(), view.similar.row(y).data(), view.colour.r.row(y).data(),
           view.colour.g.row(y).data(), view.colour.b.row(y).data()},
          {there.census.data(), nullptr, there.r.data(), there.g.data(), there.b.data()}, view.census.width(),
          stride, census, colour);
}

MatchingCost::MatchingCost(const MatchInput& input, const CostOptions& options, const Work& work)
    : options_(options),
      left_(match_view(input.left, input.left_grey, options.census, work)),
      right_{colour_planes(input.right), census_9x7(input.right_grey, work), {}, input.right_first} {}

void MatchingCost::fill_row(int y, int stride, std::uint8_t* out) const {
  struct Scratch {
    ReversedRow row;
    std::vector<std::uint8_t> colour;
  };
  thread_local Scratch scratch;
  const std::size_t count = static_cast<std::size_t>(left_.census.width()) * static_cast<std::size_t>(stride);
  scratch.row.assign(right_, y, stride);
  scratch.colour.resize(count);
  compare_row(left_, y, scratch.row, stride, out, scratch.colour.data());
  add_weighted(scratch.colour.data(), options_, count, out);
  const int last = std::min(left_.census.width(), right_.first + stride - 1);
  for (int x = 0; x < last; ++x)
    fill_out_of_view(out + static_cast<std::size_t>(x) * static_cast<std::size_t>(stride),
                     std::max(0, x + 1 - right_.first), stride, options_.out_of_view);
}

}  // namespace palpable::vision
