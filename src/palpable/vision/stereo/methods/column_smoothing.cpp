// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/column_smoothing.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/image/colour_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace palpable::vision {
namespace {

/// A row's colours, disparities and trust.
struct VoteRow {
  const std::uint8_t* r;
  const std::uint8_t* g;
  const std::uint8_t* b;
  const float* disparity_px;
  const float* trust;
};

/// An approximation of exp(-t) by products only, so that rows can be vectorised; 0 from 16 on.
inline float falloff(float t) {
  const float u = 1.0F - t / 16.0F;
  const float u1 = u > 0.0F ? u : 0.0F;
  const float u2 = u1 * u1;
  const float u4 = u2 * u2;
  const float u8 = u4 * u4;
  return u8 * u8;
}

inline int colour_difference(const VoteRow& p, const VoteRow& q, int x) {
  return std::abs(p.r[x] - q.r[x]) + std::abs(p.g[x] - q.g[x]) + std::abs(p.b[x] - q.b[x]);
}

/// Adds the vote of each pixel of `other` for the corresponding pixel of `centre`.
PALPABLE_VECTORIZE
void add_votes(const VoteRow& centre, const VoteRow& other, float row_weight, float per_level,
               float support_px, int count, float* __restrict near, float* __restrict total) {
  const std::uint8_t* __restrict r0 = centre.r;
  const std::uint8_t* __restrict g0 = centre.g;
  const std::uint8_t* __restrict b0 = centre.b;
  const std::uint8_t* __restrict r1 = other.r;
  const std::uint8_t* __restrict g1 = other.g;
  const std::uint8_t* __restrict b1 = other.b;
  const float* __restrict d0 = centre.disparity_px;
  const float* __restrict d1 = other.disparity_px;
  const float* __restrict trust = other.trust;
  for (int x = 0; x < count; ++x) {
    const int difference = std::abs(r0[x] - r1[x]) + std::abs(g0[x] - g1[x]) + std::abs(b0[x] - b1[x]);
    const float weight = falloff(static_cast<float>(difference) * per_level) * row_weight * trust[x];
    total[x] += weight;
    near[x] += std::fabs(d1[x] - d0[x]) <= support_px ? weight : 0.0F;
  }
}

class ColumnVotes {
 public:
  ColumnVotes(const ColourPlanes& colour, const Raster<float>& trust, const Raster<float>& disparity_px,
              const ColumnOptions& options)
      : colour_(colour),
        trust_(trust),
        disparity_px_(disparity_px),
        options_(options),
        per_level_(1.0F / (3.0F * options.colour_levels)),
        near_(static_cast<std::size_t>(colour.width())),
        total_(near_) {
    for (int v = 0; v <= options.reach_px; ++v)
      by_distance_.push_back(std::exp(-static_cast<float>(v) / static_cast<float>(options.reach_px)));
  }

  /// For each pixel of the row, the share of the votes around it that support its disparity.
  void shares(int y, std::vector<float>& out) {
    const int width = colour_.width();
    std::fill(near_.begin(), near_.end(), 0.0F);
    std::fill(total_.begin(), total_.end(), 0.0F);
    for (int v = first_row(y); v <= last_row(y); ++v)
      for (int u = -options_.half_width_px; u <= options_.half_width_px; ++u) {
        const int first = std::max(0, -u);
        const int count = std::min(width, width - u) - first;
        add_votes(row(first, y), row(first + u, v), row_weight(v - y), per_level_, options_.support_px, count,
                  near_.data() + first, total_.data() + first);
      }
    for (std::size_t x = 0; x < out.size(); ++x) out[x] = near_[x] / total_[x];
  }

  /// The weighted mean of the votes around (x, y) near their weighted median.
  float reasonable(int x, int y) {
    const float median = weighted_median(collect(x, y));
    float sum = 0.0F;
    float weight = 0.0F;
    for (const Vote& vote : votes_) {
      if (std::abs(vote.disparity_px - median) > options_.support_px) continue;
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

  int first_row(int y) const { return std::max(0, y - options_.reach_px); }
  int last_row(int y) const { return std::min(colour_.height() - 1, y + options_.reach_px); }
  float row_weight(int distance) const { return by_distance_[static_cast<std::size_t>(std::abs(distance))]; }
  VoteRow row(int x, int y) const {
    const auto at = [&](const auto& raster) { return raster.row(y).data() + x; };
    return {at(colour_.r), at(colour_.g), at(colour_.b), at(disparity_px_), at(trust_)};
  }

  /// The weighted median of the votes' disparities.
  float weighted_median(float total) {
    auto first = votes_.begin();
    auto last = votes_.end();
    float below = 0.0F;
    while (last - first > 1) {
      const auto middle = first + (last - first) / 2;
      std::nth_element(first, middle, last,
                       [](const Vote& a, const Vote& b) { return a.disparity_px < b.disparity_px; });
      float up_to_middle = below;
      for (auto vote = first; vote != middle; ++vote) up_to_middle += vote->weight;
      if (2.0F * up_to_middle >= total) {
        last = middle;
      } else {
        first = middle;
        below = up_to_middle;
        if (2.0F * (below + middle->weight) >= total) break;
        below += middle->weight;
        ++first;
      }
    }
    return first == votes_.end() ? votes_.back().disparity_px : first->disparity_px;
  }

  /// The votes around (x, y), and their sum.
  float collect(int x, int y) {
    votes_.clear();
    float total = 0.0F;
    const VoteRow centre = row(x, y);
    const int left = std::max(0, x - options_.half_width_px);
    const int right = std::min(colour_.width() - 1, x + options_.half_width_px);
    for (int v = first_row(y); v <= last_row(y); ++v)
      for (int u = left; u <= right; ++u) {
        const VoteRow voter = row(u, v);
        const int difference = colour_difference(centre, voter, 0);
        const float weight =
            falloff(static_cast<float>(difference) * per_level_) * row_weight(v - y) * *voter.trust;
        votes_.push_back({disparity_px_(u, v), weight});
        total += weight;
      }
    return total;
  }

  const ColourPlanes& colour_;
  const Raster<float>& trust_;
  const Raster<float>& disparity_px_;
  const ColumnOptions& options_;
  float per_level_;
  std::vector<float> near_, total_;
  std::vector<float> by_distance_;
  std::vector<Vote> votes_;
};

}  // namespace

std::vector<Parameter> parameters_of(ColumnOptions& o) {
  return {
      {"reach_px", &o.reach_px, {1, 60}, "px", "Rows above and below that vote"},
      {"half_width_px", &o.half_width_px, {0, 10}, "px", "Columns beside that vote"},
      {"colour_levels",
       &o.colour_levels,
       {1, 255},
       "levels",
       "Colour difference at which a weight falls by e"},
      {"untrusted_weight", &o.untrusted_weight, {0.001, 1}, "", "Weight of an untrusted pixel"},
      {"support_px", &o.support_px, {0.1, 10}, "px", "Disparities that differ by less support each other"},
      {"outlier_share", &o.outlier_share, {0, 1}, "", "Less support makes an outlier"},
      {"streak_share", &o.streak_share, {0, 1}, "", "Less support makes an outlier's neighbour one too"}};
}

void smooth_columns(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& trusted,
                    const ColumnOptions& options, Raster<float>& disparity_px, const Work& work) {
  const Raster<float> before = disparity_px;
  const ColourPlanes colour = colour_planes(picture);
  Raster<float> trust(picture.width(), picture.height());
  for (std::size_t i = 0; i < trust.count(); ++i)
    trust.values()[i] = trusted.values()[i] != 0 ? 1.0F : options.untrusted_weight;
  parallel_for(work, picture.height(), 8, [&](int begin, int end) {
    ColumnVotes votes(colour, trust, before, options);
    std::vector<float> shares(static_cast<std::size_t>(picture.width()));
    std::vector<std::uint8_t> done(shares.size());
    for (int y = begin; y < end; ++y) {
      votes.shares(y, shares);
      std::fill(done.begin(), done.end(), std::uint8_t{0});
      // Follows the streak from each outlier along the scanline in both directions.
      for (const int direction : {1, -1}) {
        bool in_streak = false;
        for (int k = 0; k < picture.width(); ++k) {
          const int x = direction > 0 ? k : picture.width() - 1 - k;
          const auto i = static_cast<std::size_t>(x);
          const bool goes_on = in_streak && shares[i] < options.streak_share &&
                               std::abs(before(x, y) - before(x - direction, y)) <= options.support_px;
          in_streak = shares[i] < options.outlier_share || goes_on;
          if (!in_streak || done[i] != 0) continue;
          disparity_px(x, y) = votes.reasonable(x, y);
          done[i] = 1;
        }
      }
    }
  });
}

}  // namespace palpable::vision
