// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/step_median.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace palpable::vision {
namespace {

/// Bins of the histograms: narrow enough that a bin holds one surface.
constexpr float kBinsPerPixel = 2.0F;
/// Disparities that differ by less are those of one surface.
constexpr float kSupport_px = 1.0F;

/// Weights by disparity, reused between pixels: only used bins are cleared.
class DisparityHistogram {
 public:
  DisparityHistogram(float least_px, float greatest_px)
      : least_px_(least_px), bins_(static_cast<std::size_t>((greatest_px - least_px) * kBinsPerPixel) + 1) {}

  void add(float disparity_px, float weight) {
    const auto bin = static_cast<std::size_t>((disparity_px - least_px_) * kBinsPerPixel);
    bins_[bin].weight += weight;
    bins_[bin].sum += weight * disparity_px;
    total_ += weight;
    low_ = std::min(low_, bin);
    high_ = std::max(high_, bin);
  }
  /// The share of the weights in bins whose mean is within kSupport_px of a disparity. At least one value was
  /// added.
  float support(float disparity_px) const {
    float near = 0.0F;
    for (std::size_t i = low_; i <= high_; ++i)
      if (bins_[i].weight > 0.0F && std::fabs(bins_[i].sum / bins_[i].weight - disparity_px) < kSupport_px)
        near += bins_[i].weight;
    return near / total_;
  }
  /// The mean of the bin that holds the weighted median; clears the weights. At least one value was added.
  float median() {
    float below = 0.0F, out = 0.0F;
    for (std::size_t i = low_; i <= high_; ++i) {
      if (bins_[i].weight > 0.0F && 2.0F * below < total_) out = bins_[i].sum / bins_[i].weight;
      below += bins_[i].weight;
      bins_[i] = {};
    }
    total_ = 0.0F;
    low_ = bins_.size();
    high_ = 0;
    return out;
  }

 private:
  struct Bin {
    float weight = 0.0F, sum = 0.0F;
  };
  float least_px_;
  std::vector<Bin> bins_;
  float total_ = 0.0F;
  std::size_t low_ = bins_.size(), high_ = 0;
};

/// 1 where a neighbour in the row or column differs by more than `least_px`.
Raster<std::uint8_t> steps_of(const Raster<float>& disparity_px, float least_px) {
  Raster<std::uint8_t> out(disparity_px.width(), disparity_px.height());
  const auto compare = [&](int x, int y, int u, int v) {
    if (!disparity_px.contains(u, v) || std::fabs(disparity_px(x, y) - disparity_px(u, v)) <= least_px)
      return;
    out(x, y) = out(u, v) = 1;
  };
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      compare(x, y, x + 1, y);
      compare(x, y, x, y + 1);
    }
  return out;
}

/// Calls mark(i) for each of `count` places that is at most `reach` from one where marked(i).
template <class Marked, class Mark>
void mark_around(int count, int reach, const Marked& marked, const Mark& mark) {
  int ahead = 0, behind = 0;
  for (int i = 0; i < count; ++i) {
    ahead = marked(i) ? reach + 1 : ahead - 1;
    behind = marked(count - 1 - i) ? reach + 1 : behind - 1;
    if (ahead > 0) mark(i);
    if (behind > 0) mark(count - 1 - i);
  }
}

/// 1 in the squares of 2 reach + 1 pixels around marked pixels.
Raster<std::uint8_t> widened(const Raster<std::uint8_t>& marks, int reach) {
  Raster<std::uint8_t> rows(marks.width(), marks.height()), out = rows;
  for (int y = 0; y < marks.height(); ++y)
    mark_around(
        marks.width(), reach, [&](int x) { return marks(x, y) != 0; }, [&](int x) { rows(x, y) = 1; });
  for (int x = 0; x < marks.width(); ++x)
    mark_around(
        marks.height(), reach, [&](int y) { return rows(x, y) != 0; }, [&](int y) { out(x, y) = 1; });
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(StepMedianOptions& o) {
  return {{"rounds", &o.rounds, {0, 10}, "", "Medians at steps of disparity"},
          {"least_step_px", &o.least_step_px, {0.1, 100}, "px", "Neighbours that differ by more are a step"},
          {"reach_px", &o.reach_px, {1, 60}, "px", "Reach of the window to each side"},
          {"every_px", &o.every_px, {1, 8}, "px", "Every n-th row and column of the window is used"},
          {"colour_levels",
           &o.colour_levels,
           {1, 255},
           "levels",
           "Colour difference at which a weight falls by e"},
          {"enough_support", &o.enough_support, {0, 1}, "", "Share of the weights that keeps a disparity"},
          {"least_change_px", &o.least_change_px, {0, 100}, "px", "Smaller changes are not made"}};
}

void median_at_steps(const ColourPlanes& colour, const StepMedianOptions& options,
                     Raster<float>& disparity_px, const Work& work) {
  std::array<float, 256> weight_of{};
  for (std::size_t i = 0; i < weight_of.size(); ++i)
    weight_of[i] = std::exp(-static_cast<float>(i) / options.colour_levels);
  const int reach = options.reach_px;
  for (int round = 0; round < options.rounds; ++round) {
    const Raster<float> before = disparity_px;
    const auto range = std::minmax_element(before.values().begin(), before.values().end());
    const Raster<std::uint8_t> near = widened(steps_of(before, options.least_step_px), reach);
    parallel_for(work, before.height(), 8, [&](int begin, int end) {
      DisparityHistogram votes(*range.first, *range.second);
      for (int y = begin; y < end && !work.cancelled(); ++y)
        for (int x = 0; x < before.width(); ++x) {
          if (near(x, y) == 0) continue;
          for (int v = y - reach; v <= y + reach; v += options.every_px)
            for (int u = x - reach; u <= x + reach; u += options.every_px)
              if (before.contains(u, v))
                votes.add(before(u, v), weight_of[static_cast<std::size_t>(colour.difference(x, y, u, v))]);
          const bool supported = votes.support(before(x, y)) >= options.enough_support;
          const float median = votes.median();
          if (!supported && std::fabs(median - before(x, y)) > options.least_change_px)
            disparity_px(x, y) = median;
        }
    });
  }
}

}  // namespace palpable::vision
