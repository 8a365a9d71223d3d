// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/column_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace palpable::vision {
namespace {

constexpr int kColourSums = 3 * 255 + 1;

class ColumnVotes {
 public:
  ColumnVotes(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& trusted,
              const Raster<float>& disparity_px, const ColumnOptions& options)
      : picture_(picture), trusted_(trusted), disparity_px_(disparity_px), options_(options) {
    for (int i = 0; i < kColourSums; ++i)
      by_colour_[static_cast<std::size_t>(i)] =
          std::exp(-static_cast<float>(i) / (3.0F * options.colour_levels));
    for (int v = 0; v <= options.reach_px; ++v)
      by_distance_.push_back(std::exp(-static_cast<float>(v) / static_cast<float>(options.reach_px)));
  }

  /// The share of the votes around (x, y) within one pixel of its disparity. The votes stay for reasonable().
  float share(int x, int y) {
    votes_.clear();
    total_ = 0.0F;
    float near = 0.0F;
    const Rgb8 centre = picture_(x, y);
    const float own = disparity_px_(x, y);
    const int left = std::max(0, x - options_.half_width_px);
    const int right = std::min(picture_.width() - 1, x + options_.half_width_px);
    const int last = std::min(picture_.height() - 1, y + options_.reach_px);
    for (int v = std::max(0, y - options_.reach_px); v <= last; ++v) {
      const float row_weight = by_distance_[static_cast<std::size_t>(std::abs(v - y))];
      for (int u = left; u <= right; ++u) {
        const Rgb8 c = picture_(u, v);
        const int difference = std::abs(c.r - centre.r) + std::abs(c.g - centre.g) + std::abs(c.b - centre.b);
        const float trust = trusted_(u, v) != 0 ? 1.0F : options_.untrusted_vote;
        const float weight = by_colour_[static_cast<std::size_t>(difference)] * row_weight * trust;
        const float d = disparity_px_(u, v);
        votes_.push_back({d, weight});
        total_ += weight;
        if (std::abs(d - own) <= 1.0F) near += weight;
      }
    }
    return near / total_;
  }

  /// The weighted mean of the votes within one pixel of their weighted median.
  float reasonable() {
    std::sort(votes_.begin(), votes_.end(),
              [](const Vote& a, const Vote& b) { return a.disparity_px < b.disparity_px; });
    float half = 0.0F;
    float median = votes_.back().disparity_px;
    for (const Vote& vote : votes_) {
      half += vote.weight;
      if (2.0F * half >= total_) {
        median = vote.disparity_px;
        break;
      }
    }
    float sum = 0.0F;
    float weight = 0.0F;
    for (const Vote& vote : votes_) {
      if (std::abs(vote.disparity_px - median) > 1.0F) continue;
      sum += vote.weight * vote.disparity_px;
      weight += vote.weight;
    }
    return sum / weight;
  }

 private:
  struct Vote {
    float disparity_px;
    float weight;
  };
  const Raster<Rgb8>& picture_;
  const Raster<std::uint8_t>& trusted_;
  const Raster<float>& disparity_px_;
  const ColumnOptions& options_;
  std::array<float, kColourSums> by_colour_{};
  std::vector<float> by_distance_;
  std::vector<Vote> votes_;
  float total_ = 0.0F;
};

}  // namespace

void smooth_columns(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& trusted,
                    const ColumnOptions& options, Raster<float>& disparity_px, const Work& work) {
  const Raster<float> before = disparity_px;
  parallel_for(work, picture.height(), 8, [&](int begin, int end) {
    ColumnVotes votes(picture, trusted, before, options);
    std::vector<float> shares(static_cast<std::size_t>(picture.width()));
    std::vector<float> better(static_cast<std::size_t>(picture.width()));
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const auto i = static_cast<std::size_t>(x);
        shares[i] = votes.share(x, y);
        if (shares[i] < options.streak_share) better[i] = votes.reasonable();
      }
      // From each outlier along the scanline, both ways, as far as the streak goes.
      for (const int direction : {1, -1}) {
        bool in_streak = false;
        for (int k = 0; k < picture.width(); ++k) {
          const int x = direction > 0 ? k : picture.width() - 1 - k;
          const auto i = static_cast<std::size_t>(x);
          const bool goes_on = in_streak && shares[i] < options.streak_share &&
                               std::abs(before(x, y) - before(x - direction, y)) <= 1.0F;
          in_streak = shares[i] < options.outlier_share || goes_on;
          if (in_streak) disparity_px(x, y) = better[i];
        }
      }
    }
  });
}

}  // namespace palpable::vision
