// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plane_votes.hpp"

#include "palpable/vision/stereo/occlusion/left_right_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace palpable::vision {
namespace {

struct Vote {
  float disparity, slope_x, slope_y, weight;
};

/// The other picture's disparity at the match; NaN outside that picture.
float seen_at(const Raster<float>& other_disparity, Pixel p, float disparity) {
  const int there = static_cast<int>(std::floor(static_cast<float>(p.x) - disparity + 0.5F));
  return other_disparity.contains(there, p.y) ? other_disparity(there, p.y) : NAN;
}

/// The vote on one pixel; reuses its memory between pixels.
class PlaneVoting {
 public:
  explicit PlaneVoting(const PlaneVoteWindow& window) : window_(window) {
    for (int i = 0; i <= 2 * window.reach_px; ++i)
      near_.push_back(std::exp(-static_cast<float>(i) / window.distance_px));
  }

  /// The winner among the planes of pixels whose weight is above 0; alike(difference) is the weight of a
  /// colour difference, admitted(disparity) says which votes count, `quantile` of their weights lies below
  /// the winner. Weight 0: too few.
  template <class Alike, class Admitted>
  Vote winner(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight, Pixel p,
              const Alike& alike, const Admitted& admitted, float quantile) {
    votes_.clear();
    float total = 0.0F;
    for (int dy = -window_.reach_px; dy <= window_.reach_px; dy += window_.step_px)
      for (int dx = -window_.reach_px; dx <= window_.reach_px; dx += window_.step_px) {
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
    if (votes_.empty() || total < window_.least_weight) return {};
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
  PlaneVoteWindow window_;
  std::vector<float> near_;
  std::vector<Vote> votes_;
};

}  // namespace

std::vector<Parameter> parameters_of(PlaneVoteWindow& w) {
  return {{"reach_px", &w.reach_px, {1, 60}, "px", "Reach of the window to each side"},
          {"step_px", &w.step_px, {1, 16}, "px", "Every n-th row and column of the window is used"},
          {"distance_px", &w.distance_px, {1, 200}, "px", "Distance at which a weight falls by e"},
          {"colour_levels", &w.colour_levels, {1, 255}, "levels", "Colour scale of the weights"},
          {"least_weight", &w.least_weight, {0, 1000}, "", "Sum of weights below which nothing is decided"}};
}

std::vector<Parameter> parameters_of(BackgroundOptions& o) {
  std::vector<Parameter> all{
      {"behind_px", &o.behind_px, {0, 10}, "px", "A surface occludes pixels behind it by more than this"},
      {"deepest_pit_px", &o.deepest_pit_px, {0, 100}, "px", "Deeper pits are kept"},
      {"filled_weight", &o.filled_weight, {0, 1}, "", "Weight of pixels filled earlier"},
      {"hidden_quantile",
       &o.hidden_quantile,
       {0, 1},
       "",
       "Share of the votes below the winner, for occluded pixels"},
      {"out_of_view_quantile",
       &o.out_of_view_quantile,
       {0, 1},
       "",
       "The same, for pixels outside the other picture"}};
  append_parameters(all, "window", parameters_of(o.window));
  append_parameters(all, "slopes", parameters_of(o.slopes));
  append_parameters(all, "fit", parameters_of(o.fit));
  return all;
}

void continue_background(const ColourPlanes& colour, const Raster<float>& other_disparity,
                         const BackgroundOptions& options, PlaneMap& map, const Work& work) {
  const auto hidden = [&](Pixel p, float disparity) {
    // Outside the picture it is NaN or infinite: also true.
    const float in_front = seen_at(other_disparity, p, disparity);
    return !(in_front <= disparity + options.behind_px);
  };
  const auto alike = [&](int difference) {
    const float c = static_cast<float>(difference) / options.window.colour_levels;
    return 1.0F / (1.0F + c * c);
  };
  Raster<float> weight = left_right_check(map.disparity, other_disparity);
  // A single pixel's slope is too noisy for extrapolation, so slopes are fitted in wide windows on the same
  // surface.
  const PlaneMap wide = fit_planes(colour, map, weight, options.slopes, options.fit, work);
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
      PlaneVoting voting(options.window);
      for (int i = begin; i < end; ++i) {
        const Pixel p = left[static_cast<std::size_t>(i)];
        const bool in_view = std::isfinite(seen_at(other_disparity, p, map.disparity(p.x, p.y)));
        found[static_cast<std::size_t>(i)] = voting.winner(
            colour, map, weight, p, alike, [&](float d) { return hidden(p, d); },
            in_view ? options.hidden_quantile : options.out_of_view_quantile);
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
      weight(x, y) = options.filled_weight;
    }
    reached = rest.size() < left.size();
    left.swap(rest);
  }
}

void fill_pits(const ColourPlanes& colour, const Raster<float>& other_disparity,
               const BackgroundOptions& options, const PlaneVoteWindow& window, PlaneMap& map,
               const Work& work) {
  constexpr float kMedian = 0.5F;
  const auto alike = [&](int difference) {
    return std::exp(-static_cast<float>(difference) / window.colour_levels);
  };
  const int w = colour.width();
  const Raster<float> agreed = left_right_check(map.disparity, other_disparity);
  PlaneMap out = map;
  parallel_for(work, colour.height(), 4, [&](int begin, int end) {
    PlaneVoting voting(window);
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      const auto hidden = [&](int x) {
        const float d = map.disparity(x, y);
        const float in_front = seen_at(other_disparity, {x, y}, d) - d;
        return std::isfinite(in_front) && in_front > options.behind_px;
      };
      for (int first = 1, last = 1; first + 1 < w; first = last + 1) {
        last = first;
        if (!hidden(first)) continue;
        while (last + 2 < w && hidden(last + 1)) ++last;
        const float on_left = map.disparity(first - 1, y), on_right = map.disparity(last + 1, y);
        if (on_right - on_left > options.behind_px) continue;
        if (on_left - map.disparity(first, y) > options.deepest_pit_px) continue;
        for (int x = first; x <= last; ++x) {
          const Vote vote = voting.winner(
              colour, map, agreed, {x, y}, alike, [](float) { return true; }, kMedian);
          if (vote.weight <= 0.0F) continue;
          out.disparity(x, y) = vote.disparity;
          out.slope_x(x, y) = vote.slope_x;
          out.slope_y(x, y) = vote.slope_y;
        }
      }
    }
  });
  map = std::move(out);
}

Raster<float> replace_contradicted(const ColourPlanes& colour, const Raster<float>& other_disparity,
                                   const PlaneVoteWindow& window, const PlaneMap& map, const Work& work) {
  constexpr float kMedian = 0.5F;
  const auto alike = [&](int difference) {
    return std::exp(-static_cast<float>(difference) / window.colour_levels);
  };
  const Raster<float> agreed = left_right_check(map.disparity, other_disparity);
  Raster<float> out = map.disparity;
  parallel_for(work, out.height(), 4, [&](int begin, int end) {
    PlaneVoting voting(window);
    for (int y = begin; y < end && !work.cancelled(); ++y)
      for (int x = 0; x < out.width(); ++x) {
        const Pixel p{x, y};
        const float d = map.disparity(x, y);
        // Only a farther surface in the other picture contradicts.
        if (agreed(x, y) > 0.0F || !(seen_at(other_disparity, p, d) <= d)) continue;
        const Vote vote = voting.winner(
            colour, map, agreed, p, alike, [](float) { return true; }, kMedian);
        if (vote.weight > 0.0F) out(x, y) = vote.disparity;
      }
  });
  return out;
}

}  // namespace palpable::vision
