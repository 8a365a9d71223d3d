// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/confidence/match_margin.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/stereo/cost/matching_cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace palpable::vision {
namespace {

constexpr int kRows = 2 * kMarginReach_px + 1;
constexpr CostOptions kCosts{.census_weight = 1, .colour_limit = 20, .colour_weight = 1};

PALPABLE_VECTORIZE void add_and_remove(const std::uint8_t* __restrict more,
                                       const std::uint8_t* __restrict less, std::size_t count,
                                       std::uint16_t* __restrict sum) {
  for (std::size_t i = 0; i < count; ++i) sum[i] = static_cast<std::uint16_t>(sum[i] + more[i] - less[i]);
}

PALPABLE_VECTORIZE void add_columns(const std::uint16_t* __restrict more,
                                    const std::uint16_t* __restrict less, int count,
                                    std::uint16_t* __restrict sum) {
  for (int i = 0; i < count; ++i) sum[i] = static_cast<std::uint16_t>(sum[i] + more[i] - less[i]);
}

PALPABLE_VECTORIZE std::uint16_t least_of(const std::uint16_t* values, int begin, int end) {
  std::uint16_t least = 65535;
  for (int i = begin; i < end; ++i) least = values[i] < least ? values[i] : least;
  return least;
}

/// The sums of the costs of rows y - reach … y + reach, column by column.
class ColumnSums {
 public:
  ColumnSums(const MatchingCost& costs, int width, int height, int stride)
      : costs_(costs),
        height_(height),
        stride_(stride),
        sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(stride)) {
    rows_.fill(std::vector<std::uint8_t>(sums_.size()));
  }

  /// Adds row `newest`, which counts as 0 outside the picture, and removes the one that leaves the window.
  void advance(int newest) {
    std::vector<std::uint8_t>& row = rows_[static_cast<std::size_t>(newest + kRows) % kRows];
    leaving_.swap(row);
    row.resize(sums_.size());
    if (newest >= 0 && newest < height_)
      costs_.fill_row(newest, stride_, row.data());
    else
      std::fill(row.begin(), row.end(), std::uint8_t{0});
    add_and_remove(row.data(), leaving_.data(), sums_.size(), sums_.data());
  }
  const std::uint16_t* at(int x) const {
    return sums_.data() + static_cast<std::size_t>(x) * static_cast<std::size_t>(stride_);
  }

 private:
  const MatchingCost& costs_;
  int height_, stride_;
  std::vector<std::uint8_t> leaving_;
  std::array<std::vector<std::uint8_t>, kRows> rows_;
  std::vector<std::uint16_t> sums_;
};

struct Margin {
  float cost = kUnlikeCost;
  float margin = 0.0F;
};

/// Of one pixel, from the sums of `pixels` pixels, of which the first `known` disparities are inside the
/// picture.
Margin margin_of(const std::uint16_t* sums, int known, float pixels, float disparity_px) {
  Margin out;
  const int at = std::isfinite(disparity_px) ? static_cast<int>(std::lround(disparity_px)) : -1;
  if (at >= 0 && at < known) out.cost = static_cast<float>(sums[at]) / pixels;
  const std::uint16_t elsewhere = std::min(least_of(sums, 0, std::min(known, at - kSameMinimum_px)),
                                           least_of(sums, std::max(0, at + kSameMinimum_px + 1), known));
  // Where no other match lies inside the picture, nothing tells this one from others.
  if (elsewhere != 65535) out.margin = static_cast<float>(elsewhere) / pixels - out.cost;
  return out;
}

}  // namespace

MatchMargin match_margin(const MatchInput& input, const Raster<float>& disparity_px, const Work& work) {
  constexpr int kReach = kMarginReach_px, kStripeRows = 48;
  const int width = disparity_px.width(), height = disparity_px.height();
  const int stride = whole_vectors(input.disparities);
  const MatchingCost costs(input, kCosts, work);
  MatchMargin out{Raster<float>(width, height), Raster<float>(width, height)};
  parallel_for(work, height, kStripeRows, [&](int begin, int end) {
    ColumnSums columns(costs, width, height, stride);
    const std::vector<std::uint16_t> nothing(static_cast<std::size_t>(stride));
    std::vector<std::uint16_t> sums(nothing.size());
    for (int y = begin - kReach; y < begin + kReach; ++y) columns.advance(y);
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      columns.advance(y + kReach);
      const int rows = std::min(height - 1, y + kReach) - std::max(0, y - kReach) + 1;
      std::fill(sums.begin(), sums.end(), std::uint16_t{0});
      for (int x = -kReach; x < width; ++x) {
        add_columns(x + kReach < width ? columns.at(x + kReach) : nothing.data(),
                    x > kReach ? columns.at(x - kReach - 1) : nothing.data(), stride, sums.data());
        if (x < 0) continue;
        const int across = std::min(width - 1, x + kReach) - std::max(0, x - kReach) + 1;
        const Margin found = margin_of(sums.data(), std::clamp(x + 1 - input.right_first, 0, stride),
                                       static_cast<float>(rows * across), disparity_px(x, y));
        out.cost(x, y) = found.cost;
        out.margin(x, y) = found.margin;
      }
    }
  });
  return out;
}

}  // namespace palpable::vision
