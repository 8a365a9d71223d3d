// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/colour_votes.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace palpable::vision {
namespace {

/// The votes for each disparity, kept between pixels so that only what was touched is cleared.
class Ballot {
 public:
  explicit Ballot(int disparities) : weight_(static_cast<std::size_t>(disparities)) {}

  void add(int disparity, float weight) {
    weight_[static_cast<std::size_t>(disparity)] += weight;
    total_ += weight;
    low_ = std::min(low_, disparity);
    high_ = std::max(high_, disparity);
  }
  bool empty() const { return total_ <= 0.0F; }
  /// The weighted median; clears the votes.
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

Raster<int> voted(const ColourPlanes& picture, const Raster<int>& disparity_px, const Raster<float>& trust,
                  int disparities, const VoteOptions& options, const Work& work) {
  std::array<float, 256> by_colour{};
  for (std::size_t i = 0; i < by_colour.size(); ++i)
    by_colour[i] = std::exp(-static_cast<float>(i) / options.colour_levels);
  std::vector<float> by_distance;
  for (int i = 0; i <= 2 * options.reach_px; ++i)
    by_distance.push_back(std::exp(-static_cast<float>(i) / options.distance_px));
  Raster<int> out = disparity_px;
  parallel_for(work, out.height(), 8, [&](int begin, int end) {
    Ballot ballot(disparities);
    for (int y = begin; y < end && !work.cancelled(); ++y)
      for (int x = 0; x < out.width(); ++x) {
        for (int v = y - options.reach_px; v <= y + options.reach_px; v += options.step_px)
          for (int u = x - options.reach_px; u <= x + options.reach_px; u += options.step_px) {
            if (!trust.contains(u, v)) continue;
            if (trust(u, v) <= 0.0F) continue;
            const int apart = std::abs(u - x) + std::abs(v - y);
            ballot.add(disparity_px(u, v),
                       by_colour[static_cast<std::size_t>(picture.difference(x, y, u, v))] *
                           by_distance[static_cast<std::size_t>(apart)] * trust(u, v));
          }
        if (!ballot.empty()) out(x, y) = ballot.median();
      }
  });
  return out;
}

}  // namespace palpable::vision
