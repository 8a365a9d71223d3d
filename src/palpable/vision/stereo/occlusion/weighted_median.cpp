// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/weighted_median.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace palpable::vision {
namespace {

/// Weights by disparity, reused between pixels: only used bins are cleared.
class WeightHistogram {
 public:
  explicit WeightHistogram(int disparities) : weight_(static_cast<std::size_t>(disparities)) {}

  void add(int disparity, float weight) {
    weight_[static_cast<std::size_t>(disparity)] += weight;
    total_ += weight;
    low_ = std::min(low_, disparity);
    high_ = std::max(high_, disparity);
  }
  bool empty() const { return total_ <= 0.0F; }
  /// The weighted median; clears the weights.
  int median() {
    float sum = 0.0F;
    int at = low_;
    for (int d = low_; d <= high_; ++d) {
      float& weight = weight_[static_cast<std::size_t>(d)];
      if (2.0F * sum < total_) at = d;
      sum += weight;
      weight = 0.0F;
    }
    total_ = 0.0F;
    low_ = static_cast<int>(weight_.size());
    high_ = -1;
    return at;
  }

 private:
  std::vector<float> weight_;
  float total_ = 0.0F;
  int low_ = static_cast<int>(weight_.size());
  int high_ = -1;
};

}  // namespace

std::vector<Parameter> parameters_of(WeightedMedianOptions& o) {
  return {{"reach_px", &o.reach_px, {0, 60}, "px", "Reach of the window to each side"},
          {"step_px", &o.step_px, {1, 8}, "px", "Every n-th row and column of the window is used"},
          {"colour_levels",
           &o.colour_levels,
           {1, 255},
           "levels",
           "Colour difference at which a weight falls by e"},
          {"distance_px", &o.distance_px, {1, 200}, "px", "Distance at which a weight falls by e"}};
}

Raster<int> weighted_median(const ColourPlanes& picture, const Raster<int>& disparity_px,
                            const Raster<float>& trust, int disparities, const WeightedMedianOptions& options,
                            const Work& work) {
  std::array<float, 256> by_colour{};
  for (std::size_t i = 0; i < by_colour.size(); ++i)
    by_colour[i] = std::exp(-static_cast<float>(i) / options.colour_levels);
  std::vector<float> by_distance;
  for (int i = 0; i <= 2 * options.reach_px; ++i)
    by_distance.push_back(std::exp(-static_cast<float>(i) / options.distance_px));
  Raster<int> out = disparity_px;
  parallel_for(work, out.height(), 8, [&](int begin, int end) {
    WeightHistogram weights(disparities);
    for (int y = begin; y < end && !work.cancelled(); ++y)
      for (int x = 0; x < out.width(); ++x) {
        for (int v = y - options.reach_px; v <= y + options.reach_px; v += options.step_px)
          for (int u = x - options.reach_px; u <= x + options.reach_px; u += options.step_px) {
            if (!trust.contains(u, v)) continue;
            if (trust(u, v) <= 0.0F) continue;
            const int apart = std::abs(u - x) + std::abs(v - y);
            weights.add(disparity_px(u, v),
                        by_colour[static_cast<std::size_t>(picture.difference(x, y, u, v))] *
                            by_distance[static_cast<std::size_t>(apart)] * trust(u, v));
          }
        if (!weights.empty()) out(x, y) = weights.median();
      }
  });
  return out;
}

}  // namespace palpable::vision
