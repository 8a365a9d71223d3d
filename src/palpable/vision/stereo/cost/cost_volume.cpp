// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/cost_volume.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/numbers/vectorize.hpp"

#include <array>
#include <cmath>

namespace palpable::vision {
namespace {

constexpr int kLanes = 32;

struct CostTables {
  std::array<std::uint16_t, 256> colour{};
  std::array<std::uint16_t, 64> census{};

  explicit CostTables(const VolumeOptions& options) {
    const auto cost = [](float ratio) {
      return static_cast<std::uint16_t>(std::lround(kCostUnit * (1.0F - std::exp(-ratio))));
    };
    for (std::size_t i = 0; i < colour.size(); ++i)
      colour[i] = cost(static_cast<float>(i) / options.colour_scale);
    for (std::size_t i = 0; i < census.size(); ++i)
      census[i] = cost(static_cast<float>(i) / options.census_scale);
  }
};

void fill_out_of_view(std::uint16_t* cost, int known, int stride, float share) {
  if (known >= stride) return;
  if (known == 0) {
    std::fill(cost, cost + stride, static_cast<std::uint16_t>(kCostUnit));
    return;
  }
  std::uint64_t sum = 0;
  std::uint16_t least = cost[0];
  for (int d = 0; d < known; ++d) {
    sum += cost[d];
    least = std::min(least, cost[d]);
  }
  const float mean = static_cast<float>(sum) / static_cast<float>(known);
  const auto low = static_cast<float>(least);
  std::fill(cost + known, cost + stride, static_cast<std::uint16_t>(low + share * (mean - low)));
}

PALPABLE_VECTORIZE
void add_row(const std::uint16_t* __restrict from, std::uint16_t* __restrict sum, int count) {
  for (int i = 0; i < count; ++i) sum[i] = static_cast<std::uint16_t>(sum[i] + from[i]);
}

PALPABLE_VECTORIZE
void add_wide(const std::uint16_t* __restrict from, std::uint32_t* __restrict sum, int count) {
  for (int i = 0; i < count; ++i) sum[i] += from[i];
}

PALPABLE_VECTORIZE
void divide(const std::uint32_t* __restrict sum, float pixels, std::uint16_t* __restrict out, int count) {
  const float scale = 1.0F / pixels;
  for (int i = 0; i < count; ++i)
    out[i] = static_cast<std::uint16_t>(
        static_cast<int>(static_cast<float>(static_cast<int>(sum[i])) * scale + 0.5F));
}

}  // namespace

CostVolume::CostVolume(int width_, int height_, int disparities_)
    : width(width_),
      height(height_),
      disparities(disparities_),
      stride((disparities_ + kLanes - 1) / kLanes * kLanes),
      cost(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
           static_cast<std::size_t>(stride)) {}

std::vector<Parameter> parameters_of(VolumeOptions& o) {
  std::vector<Parameter> all{
      {"colour_scale", &o.colour_scale, {1, 255}, "levels", "Colour difference that costs 1 - 1/e units"},
      {"census_scale", &o.census_scale, {1, 63}, "bits", "Census distance that costs 1 - 1/e units"},
      {"out_of_view",
       &o.out_of_view,
       {0, 1},
       "",
       "Cost of a match outside the picture: 0 = the pixel's least, 1 = its mean"}};
  append_parameters(all, "census", parameters_of(o.census));
  std::vector<Parameter> cross = parameters_of(o.cross);
  for (Parameter& p : cross)
    if (p.name == "row_reach_px" || p.name == "column_reach_px") p.range.most = kLongestVolumeArm;
  append_parameters(all, "cross", std::move(cross));
  return all;
}

void pixel_costs(const MatchView& reference, const MatchView& other, const VolumeOptions& options,
                 CostVolume& out, const Work& work) {
  const CostTables tables(options);
  parallel_for(work, out.height, 4, [&](int begin, int end) {
    const std::size_t row = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.stride);
    std::vector<std::uint8_t> colour(row);
    std::vector<std::uint8_t> census(row);
    ReversedRow there;
    for (int y = begin; y < end; ++y) {
      there.assign(other, y, out.stride);
      compare_row(reference, y, there, out.stride, census.data(), colour.data());
      for (int x = 0; x < out.width; ++x) {
        const int known = std::clamp(x + 1 - other.first, 0, out.disparities);
        const std::size_t at = static_cast<std::size_t>(x) * static_cast<std::size_t>(out.stride);
        std::uint16_t* cost = out.at(x, y);
        for (int d = 0; d < known; ++d) {
          const std::size_t i = at + static_cast<std::size_t>(d);
          cost[d] = static_cast<std::uint16_t>(tables.colour[colour[i]] + tables.census[census[i]]);
        }
        fill_out_of_view(cost, known, out.stride, options.out_of_view);
      }
    }
  });
}

void average_over_crosses(const ColourPlanes& colour, const CrossOptions& cross, CostVolume& volume,
                          CostVolume& scratch, const Work& work) {
  PALPABLE_CHECK(cross.row_reach_px <= kLongestVolumeArm);
  const Raster<CrossArms> arm_of = cross_arms(colour, cross, work);
  const int stride = volume.stride;
  parallel_for(work, volume.height, 4, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < volume.width; ++x) {
        const CrossArms a = arm_of(x, y);
        std::uint16_t* sum = scratch.at(x, y);
        std::copy_n(volume.at(x - a.left, y), stride, sum);
        for (int s = x - a.left + 1; s <= x + a.right; ++s) add_row(volume.at(s, y), sum, stride);
      }
  });
  parallel_for(work, volume.height, 4, [&](int begin, int end) {
    std::vector<std::uint32_t> sum(static_cast<std::size_t>(stride));
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < volume.width; ++x) {
        const CrossArms a = arm_of(x, y);
        std::fill(sum.begin(), sum.end(), 0U);
        int pixels = 0;
        for (int t = y - a.up; t <= y + a.down; ++t) {
          add_wide(scratch.at(x, t), sum.data(), stride);
          pixels += arm_of(x, t).left + 1 + arm_of(x, t).right;
        }
        divide(sum.data(), static_cast<float>(pixels), volume.at(x, y), stride);
      }
  });
}

}  // namespace palpable::vision
