// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/cross_window.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

namespace palpable::vision {
namespace {

/// Lengthens arms by one where the next pixel is similar to the centre.
PALPABLE_VECTORIZE void grow(const std::uint8_t* __restrict difference, int limit, int count,
                             std::uint8_t* __restrict alive, std::uint8_t* __restrict length) {
  const auto most = static_cast<std::uint8_t>(limit);
  for (int x = 0; x < count; ++x) {
    alive[x] = static_cast<std::uint8_t>(alive[x] & (difference[x] <= most ? 1 : 0));
    length[x] = static_cast<std::uint8_t>(length[x] + alive[x]);
  }
}

/// Scratch rows for growing arms.
struct ArmRows {
  std::vector<std::uint8_t> difference, alive, length;
  explicit ArmRows(int width)
      : difference(static_cast<std::size_t>(width)), alive(difference), length(difference) {}
};

/// The arms of a whole row in the direction (dx, dy).
void grow_arms(const ColourPlanes& picture, int y, int dx, int dy, const CrossOptions& options,
               ArmRows& rows) {
  auto& [difference, alive, length] = rows;
  std::fill(alive.begin(), alive.end(), std::uint8_t{1});
  std::fill(length.begin(), length.end(), std::uint8_t{0});
  const int width = picture.width();
  const int reach = dy == 0 ? options.row_reach_px : options.column_reach_px;
  for (int s = 1; s <= reach; ++s) {
    const int v = y + s * dy;
    if (v < 0 || v >= picture.height()) break;
    const int first = std::max(0, -s * dx);
    const int last = std::min(width, width - s * dx);
    if (first >= last) break;
    const int limit = s == 1                           ? options.neighbour_limit
                      : s <= options.sure_reach_px + 1 ? options.colour_limit
                                                       : options.colour_limit_beyond;
    colour_differences(picture, first, y, first + s * dx, v, last - first, difference.data());
    grow(difference.data(), limit, last - first, alive.data() + first, length.data() + first);
    // Arms end at the picture's border.
    std::fill(alive.begin(), alive.begin() + first, std::uint8_t{0});
    std::fill(alive.begin() + last, alive.end(), std::uint8_t{0});
  }
}

// Prefix sums wrap around in 16 bits, but a window's sum does not, so differences of prefix sums are correct.

PALPABLE_VECTORIZE void add_costs(const std::uint16_t* __restrict before, const std::uint8_t* __restrict cost,
                                  int count, std::uint16_t* __restrict out) {
  for (int d = 0; d < count; ++d) out[d] = static_cast<std::uint16_t>(before[d] + cost[d]);
}

PALPABLE_VECTORIZE void add_span(const std::uint16_t* __restrict above, const std::uint16_t* __restrict to,
                                 const std::uint16_t* __restrict from, int count,
                                 std::uint16_t* __restrict out) {
  for (int d = 0; d < count; ++d) out[d] = static_cast<std::uint16_t>(above[d] + (to[d] - from[d]));
}

/// out = (to - from) * kMeanCostUnit / pixels. For small windows, whose reciprocal does not fit 16 bits, the
/// sums are multiplied instead.
PALPABLE_VECTORIZE void mean_of(const std::uint16_t* __restrict to, const std::uint16_t* __restrict from,
                                int pixels, int count, std::uint16_t* __restrict out) {
  static_assert(kMeanCostUnit * kMeanCostUnit * kLargestMatchingCost <= 65535);
  const bool small = pixels <= kMeanCostUnit;
  const auto factor = static_cast<std::uint16_t>(small ? kMeanCostUnit : 1);
  const int share = (small ? 65536 : kMeanCostUnit * 65536) / pixels;
  const auto reciprocal = static_cast<std::uint16_t>(share < 65535 ? share : 65535);
  for (int d = 0; d < count; ++d) {
    const auto sum = static_cast<std::uint16_t>(static_cast<std::uint16_t>(to[d] - from[d]) * factor);
    out[d] = static_cast<std::uint16_t>((static_cast<std::uint32_t>(sum) * reciprocal) >> 16U);
  }
}

PALPABLE_VECTORIZE void round_costs(const std::uint16_t* __restrict costs, std::uint16_t most,
                                    std::size_t count, std::uint8_t* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t cost = costs[i] < most ? costs[i] : most;
    out[i] = static_cast<std::uint8_t>((cost + kMeanCostUnit / 2) / kMeanCostUnit);
  }
}

}  // namespace

std::vector<Parameter> parameters_of(CrossOptions& o) {
  return {
      {"row_reach_px", &o.row_reach_px, {0, 40}, "px", "Longest arm of a window along the row"},
      {"column_reach_px", &o.column_reach_px, {0, 40}, "px", "Longest arm of a window along the column"},
      {"colour_limit", &o.colour_limit, {0, 255}, "levels", "An arm ends if a channel differs by more"},
      {"sure_reach_px", &o.sure_reach_px, {0, 40}, "px", "Beyond it colour_limit_beyond holds"},
      {"colour_limit_beyond", &o.colour_limit_beyond, {0, 255}, "levels", "The colour limit of long arms"},
      {"neighbour_limit", &o.neighbour_limit, {0, 255}, "levels", "The colour limit of the next neighbour"}};
}

Result<void> check_window_size(const CrossOptions& options) {
  const int pixels = (2 * options.row_reach_px + 1) * (2 * options.column_reach_px + 1);
  if (pixels <= kMostWindowPixels) return {};
  return Error{ErrorCode::usage,
               "a window of these arms could have " + std::to_string(pixels) + " pixels, more than " +
                   std::to_string(kMostWindowPixels),
               "row_reach_px and column_reach_px"};
}

Raster<CrossArms> cross_arms(const ColourPlanes& picture, const CrossOptions& options, const Work& work) {
  Raster<CrossArms> out(picture.width(), picture.height());
  struct Direction {
    int dx, dy;
    std::uint8_t CrossArms::*arm;
  };
  constexpr std::array kDirections{Direction{-1, 0, &CrossArms::left}, Direction{1, 0, &CrossArms::right},
                                   Direction{0, -1, &CrossArms::up}, Direction{0, 1, &CrossArms::down}};
  parallel_for(work, picture.height(), 16, [&](int begin, int end) {
    ArmRows rows(picture.width());
    for (int y = begin; y < end; ++y)
      for (const Direction& direction : kDirections) {
        grow_arms(picture, y, direction.dx, direction.dy, options, rows);
        for (int x = 0; x < picture.width(); ++x)
          out(x, y).*direction.arm = rows.length[static_cast<std::size_t>(x)];
      }
  });
  return out;
}

CrossAggregator::CrossAggregator(const MatchingCost& cost, const Raster<CrossArms>& arms, int disparities,
                                 int column_reach_px, int first_row)
    : cost_(cost),
      arms_(arms),
      disparities_(disparities),
      stride_(whole_vectors(disparities)),
      reach_(column_reach_px),
      row_(first_row),
      summed_(std::max(0, first_row - column_reach_px)),
      ring_(2 * column_reach_px + 2) {
  const auto row = static_cast<std::size_t>(arms.width()) * static_cast<std::size_t>(stride_);
  raw_.resize(row);
  prefix_.resize(row + static_cast<std::size_t>(stride_));
  sums_.resize(row * static_cast<std::size_t>(ring_));
  pixels_.assign(static_cast<std::size_t>(ring_),
                 std::vector<std::uint32_t>(static_cast<std::size_t>(arms.width())));
}

std::uint16_t* CrossAggregator::sums(int row) {
  return sums_.data() + static_cast<std::size_t>((row + ring_) % ring_) * raw_.size();
}

void CrossAggregator::add_row() {
  const int y = summed_++;
  const auto count = static_cast<std::size_t>(stride_);
  cost_.fill_row(y, stride_, raw_.data());
  for (int x = 0; x < arms_.width(); ++x) {
    const auto at = static_cast<std::size_t>(x) * count;
    std::fill(raw_.data() + at + disparities_, raw_.data() + at + count,
              static_cast<std::uint8_t>(kLargestMatchingCost));
    add_costs(prefix_.data() + at, raw_.data() + at, stride_, prefix_.data() + at + count);
  }
  const std::uint16_t* above = sums(y - 1);
  std::uint16_t* here = sums(y);
  const auto& pixels_above = pixels_[static_cast<std::size_t>((y - 1 + ring_) % ring_)];
  auto& pixels = pixels_[static_cast<std::size_t>(y % ring_)];
  for (int x = 0; x < arms_.width(); ++x) {
    const CrossArms a = arms_(x, y);
    const auto at = static_cast<std::size_t>(x) * count;
    const auto column = static_cast<std::size_t>(x);
    add_span(above + at, prefix_.data() + (column + a.right + 1U) * count,
             prefix_.data() + (column - a.left) * count, stride_, here + at);
    pixels[column] = pixels_above[column] + a.left + a.right + 1U;
  }
}

void CrossAggregator::next_row(std::uint16_t* out) {
  const int y = row_++;
  while (summed_ <= std::min(y + reach_, arms_.height() - 1)) add_row();
  const auto count = static_cast<std::size_t>(stride_);
  for (int x = 0; x < arms_.width(); ++x) {
    const CrossArms a = arms_(x, y);
    const auto column = static_cast<std::size_t>(x);
    const int last = y + a.down;
    const int before = y - a.up - 1;
    const std::uint32_t pixels = pixels_[static_cast<std::size_t>(last % ring_)][column] -
                                 pixels_[static_cast<std::size_t>((before + ring_) % ring_)][column];
    mean_of(sums(last) + column * count, sums(before) + column * count, static_cast<int>(pixels), stride_,
            out + column * count);
  }
}

std::vector<Parameter> parameters_of(AggregationOptions& o) {
  std::vector<Parameter> all{
      {"limit", &o.limit, {1, kLargestMatchingCost}, "cost", "Mean costs are cut off here"}};
  append_parameters(all, "cost", parameters_of(o.cost));
  append_parameters(all, "window", parameters_of(o.window));
  return all;
}

std::vector<std::uint8_t> aggregated_costs(const MatchInput& input, const AggregationOptions& options,
                                           const Work& work) {
  const int height = input.left.height();
  const auto disparities = static_cast<std::size_t>(input.disparities);
  const std::size_t row = static_cast<std::size_t>(input.left.width()) * disparities;
  std::vector<std::uint8_t> out(row * static_cast<std::size_t>(height));
  const MatchingCost cost(input, options.cost, work);
  const Raster<CrossArms> arms = cross_arms(cost.left_colour(), options.window, work);
  parallel_for(work, height, 16, [&](int begin, int end) {
    CrossAggregator aggregator(cost, arms, input.disparities, options.window.column_reach_px, begin);
    const auto stride = static_cast<std::size_t>(aggregator.stride());
    std::vector<std::uint16_t> costs(row / disparities * stride);
    const auto most = static_cast<std::uint16_t>(options.limit * kMeanCostUnit);
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      aggregator.next_row(costs.data());
      std::uint8_t* to = out.data() + row * static_cast<std::size_t>(y);
      for (std::size_t x = 0; x < row / disparities; ++x)
        round_costs(costs.data() + x * stride, most, disparities, to + x * disparities);
    }
  });
  return out;
}

}  // namespace palpable::vision
