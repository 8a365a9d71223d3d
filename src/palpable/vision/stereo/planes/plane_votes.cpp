// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plane_votes.hpp"

#include "palpable/vision/stereo/occlusion/left_right.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace palpable::vision {
namespace {

struct Pixel {
  int x, y;
};

struct Vote {
  float disparity, slope_x, slope_y, weight;
};

/// Which pixels vote and how much they weigh: every `step_px`th up to `reach_px` away.
struct Electorate {
  int reach_px;
  int step_px;
  float near_px;
  /// All votes together must weigh so much.
  float fewest;
};

/// Of the votes' weights, sorted by disparity, so much lies below the winner: behind what hides it the
/// further third is right; where nothing does, neither side is likelier.
constexpr float kBehind = 0.35F, kMedian = 0.5F;

/// The other picture's disparity at the match; NaN where that lies outside it.
float seen_at(const Raster<float>& other_disparity, Pixel p, float disparity) {
  const int there = static_cast<int>(std::floor(static_cast<float>(p.x) - disparity + 0.5F));
  return other_disparity.contains(there, p.y) ? other_disparity(there, p.y) : NAN;
}

/// One pixel's poll; keeps its memory from pixel to pixel.
class Poll {
 public:
  explicit Poll(Electorate who) : who_(who) {
    for (int i = 0; i <= 2 * who.reach_px; ++i)
      near_.push_back(std::exp(-static_cast<float>(i) / who.near_px));
  }

  /// The winner among the planes of pixels whose weight is above 0; alike(difference) weighs their colours,
  /// admitted(disparity) says which votes count; the quantile is kBehind or kMedian. Weight 0: too few.
  template <class Alike, class Admitted>
  Vote winner(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight, Pixel p,
              const Alike& alike, const Admitted& admitted, float quantile) {
    votes_.clear();
    float total = 0.0F;
    for (int dy = -who_.reach_px; dy <= who_.reach_px; dy += who_.step_px)
      for (int dx = -who_.reach_px; dx <= who_.reach_px; dx += who_.step_px) {
        const int u = p.x + dx;
        const int v = p.y + dy;
        if (!weight.contains(u, v) || weight(u, v) <= 0.0F) continue;
        Vote vote{map.disparity(u, v), map.slope_x(u, v), map.slope_y(u, v), 0.0F};
        vote.disparity -= vote.slope_x * static_cast<float>(dx) + vote.slope_y * static_cast<float>(dy);
        if (!admitted(vote.disparity)) continue;
        vote.weight = weight(u, v) * alike(colour.difference(p.x, p.y, u, v)) *
                      near_[static_cast<std::size_t>(std::abs(dx) + std::abs(dy))];
        total += vote.weight;
        votes_.push_back(vote);
      }
    if (total < who_.fewest) return {};
    std::sort(votes_.begin(), votes_.end(),
              [](const Vote& a, const Vote& b) { return a.disparity < b.disparity; });
    float sum = 0.0F;
    for (const Vote& vote : votes_) {
      sum += vote.weight;
      if (sum >= quantile * total) return vote;
    }
    return votes_.back();
  }

 private:
  Electorate who_;
  std::vector<float> near_;
  std::vector<Vote> votes_;
};

}  // namespace

void carry_behind(const ColourPlanes& colour, const Raster<float>& other_disparity, PlaneMap& map,
                  const Work& work) {
  constexpr Electorate kAround{.reach_px = 20, .step_px = 2, .near_px = 12.0F, .fewest = 1.0F};
  constexpr float kLikeColour = 20.0F;
  constexpr float kBehind_px = 1.0F;
  constexpr float kCarriedWeight = 0.5F;
  const auto hidden = [&](Pixel p, float disparity) {
    // Out of view is nothing seen (NaN) or infinitely near: true as well.
    const float in_front = seen_at(other_disparity, p, disparity);
    return !(in_front <= disparity + kBehind_px);
  };
  const auto alike = [](int difference) {
    const float c = static_cast<float>(difference) / kLikeColour;
    return 1.0F / (1.0F + c * c);
  };
  Raster<float> weight = agreement(map.disparity, other_disparity);
  // One pixel's slope is noise, which would be carried far: those of wide windows on the same surface.
  const PlaneMap wide = fit_planes(colour, map, weight, {24, 4}, work);
  for (std::size_t i = 0; i < weight.count(); ++i) {
    if (!(weight.values()[i] > 0.0F)) continue;
    map.slope_x.values()[i] = wide.slope_x.values()[i];
    map.slope_y.values()[i] = wide.slope_y.values()[i];
  }
  std::vector<Pixel> left;
  for (int y = 0; y < colour.height(); ++y)
    for (int x = 0; x < colour.width(); ++x)
      if (hidden({x, y}, map.disparity(x, y))) left.push_back({x, y});
  for (bool reached = true; reached && !work.cancelled();) {
    std::vector<Vote> found(left.size());
    parallel_for(work, static_cast<int>(left.size()), 256, [&](int begin, int end) {
      Poll poll(kAround);
      for (int i = begin; i < end; ++i) {
        const Pixel p = left[static_cast<std::size_t>(i)];
        const bool in_view = std::isfinite(seen_at(other_disparity, p, map.disparity(p.x, p.y)));
        found[static_cast<std::size_t>(i)] = poll.winner(
            colour, map, weight, p, alike, [&](float d) { return hidden(p, d); },
            in_view ? kBehind : kMedian);
      }
    });
    std::vector<Pixel> rest;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const auto [x, y] = left[i];
      if (found[i].weight <= 0.0F) {
        rest.push_back(left[i]);
        continue;
      }
      map.disparity(x, y) = found[i].disparity;
      map.slope_x(x, y) = found[i].slope_x;
      map.slope_y(x, y) = found[i].slope_y;
      weight(x, y) = kCarriedWeight;
    }
    reached = rest.size() < left.size();
    left.swap(rest);
  }
}

Raster<float> settled(const ColourPlanes& colour, const Raster<float>& other_disparity, const PlaneMap& map,
                      const Work& work) {
  constexpr Electorate kAround{.reach_px = 15, .step_px = 2, .near_px = 12.0F, .fewest = 0.5F};
  constexpr float kLikeColour = 10.0F;
  const auto alike = [](int difference) { return std::exp(-static_cast<float>(difference) / kLikeColour); };
  const Raster<float> agreed = agreement(map.disparity, other_disparity);
  Raster<float> out = map.disparity;
  parallel_for(work, out.height(), 4, [&](int begin, int end) {
    Poll poll(kAround);
    for (int y = begin; y < end && !work.cancelled(); ++y)
      for (int x = 0; x < out.width(); ++x) {
        const Pixel p{x, y};
        const float d = map.disparity(x, y);
        // Only what the other picture shows further away contradicts.
        if (agreed(x, y) > 0.0F || !(seen_at(other_disparity, p, d) <= d)) continue;
        const Vote vote = poll.winner(
            colour, map, agreed, p, alike, [](float) { return true; }, kMedian);
        if (vote.weight > 0.0F) out(x, y) = vote.disparity;
      }
  });
  return out;
}

}  // namespace palpable::vision
