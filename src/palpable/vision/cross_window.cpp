// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/cross_window.hpp"

#include "palpable/core/vectorize.hpp"

#include <algorithm>
#include <cstdlib>

namespace palpable::vision {
namespace {

std::uint8_t arm(const Raster<Rgb8>& picture, int x, int y, int dx, int dy, const CrossOptions& options) {
  const Rgb8 centre = picture(x, y);
  const int reach = dy == 0 ? options.row_reach_px : options.column_reach_px;
  int length = 0;
  while (length < reach) {
    const int u = x + (length + 1) * dx;
    const int v = y + (length + 1) * dy;
    if (!picture.contains(u, v)) break;
    const Rgb8 c = picture(u, v);
    const int difference =
        std::max({std::abs(c.r - centre.r), std::abs(c.g - centre.g), std::abs(c.b - centre.b)});
    const int limit = 2 * length < options.row_reach_px ? options.colour_limit : options.colour_limit / 3;
    if (length > 0 && difference > limit)
      break;  // the next neighbour always belongs: a window is never one pixel
    ++length;
  }
  return static_cast<std::uint8_t>(length);
}

PALPABLE_VECTORIZE void add_costs(const std::uint32_t* before, const std::uint8_t* cost, int count,
                                  std::uint32_t* out) {
  for (int d = 0; d < count; ++d) out[d] = before[d] + cost[d];
}

PALPABLE_VECTORIZE void add_span(const std::uint32_t* above, const std::uint32_t* to,
                                 const std::uint32_t* from, int count, std::uint32_t* out) {
  for (int d = 0; d < count; ++d) out[d] = above[d] + (to[d] - from[d]);
}

PALPABLE_VECTORIZE void mean_of(const std::uint32_t* to, const std::uint32_t* from, float scale, int count,
                                float* out) {
  for (int d = 0; d < count; ++d)
    out[d] = static_cast<float>(static_cast<std::int32_t>(to[d] - from[d])) * scale;
}

}  // namespace

Raster<CrossArms> cross_arms(const Raster<Rgb8>& picture, const CrossOptions& options, const Work& work) {
  Raster<CrossArms> out(picture.width(), picture.height());
  parallel_for(work, picture.height(), 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < picture.width(); ++x)
        out(x, y) = {arm(picture, x, y, -1, 0, options), arm(picture, x, y, 1, 0, options),
                     arm(picture, x, y, 0, -1, options), arm(picture, x, y, 0, 1, options)};
  });
  return out;
}

CrossAggregator::CrossAggregator(const MatchingCost& cost, const Raster<CrossArms>& arms, int disparities,
                                 int column_reach_px, int first_row)
    : cost_(cost),
      arms_(arms),
      disparities_(disparities),
      reach_(column_reach_px),
      row_(first_row),
      summed_(std::max(0, first_row - column_reach_px)),
      ring_(2 * column_reach_px + 2) {
  const auto row = static_cast<std::size_t>(arms.width()) * static_cast<std::size_t>(disparities);
  raw_.resize(row);
  prefix_.resize(row + static_cast<std::size_t>(disparities));
  sums_.resize(row * static_cast<std::size_t>(ring_));
  pixels_.assign(static_cast<std::size_t>(ring_),
                 std::vector<std::uint32_t>(static_cast<std::size_t>(arms.width())));
}

std::uint32_t* CrossAggregator::sums(int row) {
  return sums_.data() + static_cast<std::size_t>((row + ring_) % ring_) * raw_.size();
}

void CrossAggregator::add_row() {
  // Sums wrap around in 32 bits; their differences do not, so the columns' sums may run on without end.
  const int y = summed_++;
  const auto count = static_cast<std::size_t>(disparities_);
  cost_.fill_row(y, raw_.data());
  for (int x = 0; x < arms_.width(); ++x) {
    const auto at = static_cast<std::size_t>(x) * count;
    add_costs(prefix_.data() + at, raw_.data() + at, disparities_, prefix_.data() + at + count);
  }
  const std::uint32_t* above = sums(y - 1);
  std::uint32_t* here = sums(y);
  const auto& pixels_above = pixels_[static_cast<std::size_t>((y - 1 + ring_) % ring_)];
  auto& pixels = pixels_[static_cast<std::size_t>(y % ring_)];
  for (int x = 0; x < arms_.width(); ++x) {
    const CrossArms a = arms_(x, y);
    const auto at = static_cast<std::size_t>(x) * count;
    const auto column = static_cast<std::size_t>(x);
    add_span(above + at, prefix_.data() + (column + a.right + 1U) * count,
             prefix_.data() + (column - a.left) * count, disparities_, here + at);
    pixels[column] = pixels_above[column] + a.left + a.right + 1U;
  }
}

void CrossAggregator::next_row(float* out) {
  const int y = row_++;
  while (summed_ <= std::min(y + reach_, arms_.height() - 1)) add_row();
  const auto count = static_cast<std::size_t>(disparities_);
  for (int x = 0; x < arms_.width(); ++x) {
    const CrossArms a = arms_(x, y);
    const auto column = static_cast<std::size_t>(x);
    const int last = y + a.down;
    const int before = y - a.up - 1;
    const std::uint32_t pixels = pixels_[static_cast<std::size_t>(last % ring_)][column] -
                                 pixels_[static_cast<std::size_t>((before + ring_) % ring_)][column];
    mean_of(sums(last) + column * count, sums(before) + column * count, 1.0F / static_cast<float>(pixels),
            disparities_, out + column * count);
  }
}

std::vector<std::uint8_t> aggregated_costs(const MatchInput& input, const CrossOptions& window, float limit,
                                           const Work& work) {
  const int height = input.left.height();
  const auto row = static_cast<std::size_t>(input.left.width()) * static_cast<std::size_t>(input.disparities);
  std::vector<std::uint8_t> out(row * static_cast<std::size_t>(height));
  const MatchingCost cost(input, CostOptions{}, work);
  const Raster<CrossArms> arms = cross_arms(input.left, window, work);
  parallel_for(work, height, 16, [&](int begin, int end) {
    CrossAggregator aggregator(cost, arms, input.disparities, window.column_reach_px, begin);
    std::vector<float> costs(row);
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      aggregator.next_row(costs.data());
      std::uint8_t* to = out.data() + row * static_cast<std::size_t>(y);
      for (std::size_t i = 0; i < row; ++i)
        to[i] = static_cast<std::uint8_t>(std::min(costs[i], limit) + 0.5F);
    }
  });
  return out;
}

}  // namespace palpable::vision
