// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/scanline_path.hpp"

#include "palpable/core/vectorize.hpp"
#include "palpable/vision/cross_window.hpp"
#include "palpable/vision/least_cost.hpp"
#include "palpable/vision/sub_pixel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palpable::vision {
namespace {

/// Above every path's cost, and stays below overflow with a move and a matching cost added.
constexpr std::int32_t kNever = 1 << 30;

using Cost = std::int32_t;

// How a cell was reached, three bits; and two flags.
enum Move : std::uint8_t {
  stay = 0,
  step_from_above = 1,
  step_from_below = 2,
  jump_down = 3,
  end_of_occlusion = 4
};
constexpr std::uint8_t kMoveBits = 7;
constexpr std::uint8_t kJumpFromHigher = 8;    // a jump to here begins above the next disparity
constexpr std::uint8_t kOcclusionGoesOn = 16;  // the pixel before was occluded too

/// All arrays are padded by one kNever cell at both ends: index d + 1 is disparity d.
PALPABLE_VECTORIZE void advance(const Cost* __restrict match, const Cost* __restrict occlusion,
                                const Cost* __restrict above, const Cost* __restrict costs, int count,
                                ScanlinePath::MoveCosts move_costs, Cost* __restrict match_next,
                                Cost* __restrict occlusion_next, std::int32_t* __restrict moves) {
  for (int d = 0; d < count; ++d) {
    const Cost higher = match[d + 2] + move_costs.step_down;
    const Cost lower = match[d] + move_costs.step_up;
    const Cost jumped = above[d] + move_costs.jump;
    const Cost hidden = occlusion[d + 1];
    Cost best = match[d + 1];
    std::int32_t move = stay;
    move = higher < best ? step_from_above : move;
    best = higher < best ? higher : best;
    move = lower < best ? step_from_below : move;
    best = lower < best ? lower : best;
    move = jumped < best ? jump_down : move;
    best = jumped < best ? jumped : best;
    move = hidden < best ? end_of_occlusion : move;
    best = hidden < best ? hidden : best;
    match_next[d + 1] = best + costs[d];
    const std::int32_t from_higher = above[d] < match[d + 2] ? kJumpFromHigher : 0;
    const Cost begins = match[d] + move_costs.jump;
    const Cost goes_on = occlusion[d];
    const std::int32_t on = goes_on < begins ? kOcclusionGoesOn : 0;
    const Cost least = (goes_on < begins ? goes_on : begins) + move_costs.occluded;
    occlusion_next[d + 1] = least < kNever ? least : kNever;
    moves[d] = move | from_higher | on;
  }
}

PALPABLE_VECTORIZE void narrow(const std::int32_t* __restrict from, int count, std::uint8_t* __restrict to) {
  for (int d = 0; d < count; ++d) to[d] = static_cast<std::uint8_t>(from[d]);
}

/// The least of match[d + 1], match[d + 2] … at each d: by doubling the reach, so that it runs in vectors.
/// All have 2 * count cells, those from `count` on kNever. Returns which of the two scratch rows holds it.
PALPABLE_VECTORIZE const Cost* least_above(const Cost* match, int count, Cost* scratch, Cost* other) {
  const Cost* from = match + 1;
  for (int reach = 1; reach < count; reach *= 2) {
    Cost* const to = scratch;
#pragma GCC ivdep
    for (int d = 0; d < count; ++d) to[d] = from[d] < from[d + reach] ? from[d] : from[d + reach];
    from = to;
    scratch = other;
    other = to;
  }
  return from;
}

Cost units(float matching_costs) { return static_cast<Cost>(std::lround(kMeanCostUnit * matching_costs)); }

}  // namespace

ScanlinePath::ScanlinePath(int width, int disparities, const PathOptions& options)
    : width_(width), disparities_(disparities), options_(options) {
  const auto columns = static_cast<std::size_t>(width);
  const auto padded = 2 * static_cast<std::size_t>(disparities) + 2;
  control_.resize(columns);
  right_best_.resize(columns);
  right_cost_.resize(columns);
  for (auto* v : {&match_, &match_next_, &occlusion_, &occlusion_next_, &above_, &above_too_})
    v->assign(padded, kNever);
  for (std::size_t contrast = 0; contrast < jump_cost_.size(); ++contrast)
    jump_cost_[contrast] = units(options.jump / (1.0F + static_cast<float>(contrast) / options.edge_levels));
  wide_moves_.resize(static_cast<std::size_t>(disparities));
  moves_.resize(columns * static_cast<std::size_t>(disparities));
}

void ScanlinePath::find_control_points(const std::int32_t* costs) {
  // The right picture's columns stand from right to left, so that x - d runs forward with d.
  std::fill(right_cost_.begin(), right_cost_.end(), kNever);
  const Cost control_cost = units(options_.control_cost);
  for (int x = 0; x < width_; ++x) {
    const Cost* c = costs + static_cast<std::size_t>(x) * static_cast<std::size_t>(disparities_);
    const auto first = static_cast<std::size_t>(width_ - 1 - x);
    keep_least(c, x, std::min(disparities_, x + 1), right_cost_.data() + first, right_best_.data() + first);
    const LeastCost least = least_cost(c, disparities_);
    const bool distinct =
        least.cost<control_cost&& static_cast<float>(least.elsewhere - kMeanCostUnit)> options_
            .control_ratio *
        static_cast<float>(least.cost);
    control_[static_cast<std::size_t>(x)] = distinct && least.at <= x ? least.at : -1;
  }
  for (int x = 0; x < width_; ++x) {
    int& d = control_[static_cast<std::size_t>(x)];
    if (d >= 0 && right_best_[static_cast<std::size_t>(width_ - 1 - x + d)] != x) d = -1;
  }
}

void ScanlinePath::step(const std::int32_t* costs, const MoveCosts& move_costs, int control,
                        std::uint8_t* moves) {
  const Cost* above = least_above(match_.data() + 1, disparities_, above_.data(), above_too_.data());
  advance(match_.data(), occlusion_.data(), above, costs, disparities_, move_costs, match_next_.data(),
          occlusion_next_.data(), wide_moves_.data());
  narrow(wide_moves_.data(), disparities_, moves);
  if (control >= 0) {
    const Cost control_cost = units(options_.control);
    for (int d = 0; d < disparities_; ++d)
      if (d != control) match_next_[static_cast<std::size_t>(d) + 1] += control_cost;
  }
  match_.swap(match_next_);
  occlusion_.swap(occlusion_next_);
}

void ScanlinePath::walk_back(const std::int32_t* costs, std::span<float> disparity_px,
                             std::span<std::uint8_t> occluded) {
  const auto count = static_cast<std::size_t>(disparities_);
  int d = static_cast<int>(std::min_element(match_.begin() + 1, match_.begin() + 1 + disparities_) -
                           match_.begin()) -
          1;
  bool hidden = false;
  for (int x = width_ - 1; x >= 0; --x) {
    const auto column = static_cast<std::size_t>(x);
    occluded[column] = hidden ? 1 : 0;
    disparity_px[column] = static_cast<float>(d) + sub_pixel_offset(costs + column * count, d, disparities_);
    if (x == 0) break;
    const std::uint8_t* moves = moves_.data() + column * count;
    if (hidden) {
      hidden = (moves[d] & kOcclusionGoesOn) != 0;
      --d;
      continue;
    }
    switch (moves[d] & kMoveBits) {
      case step_from_above:
        ++d;
        break;
      case step_from_below:
        --d;
        break;
      case jump_down:
        while ((moves[d] & kJumpFromHigher) != 0) ++d;
        ++d;
        break;
      case end_of_occlusion:
        hidden = true;
        break;
      default:
        break;
    }
  }
  // What only the left camera sees lies behind: it takes the disparity of the surface at its left.
  for (std::size_t x = 1; x < disparity_px.size(); ++x)
    if (occluded[x] != 0) disparity_px[x] = disparity_px[x - 1];
}

void ScanlinePath::find(std::span<const std::int32_t> costs, std::span<const std::uint8_t> grey,
                        std::span<float> disparity_px, std::span<std::uint8_t> occluded) {
  const auto count = static_cast<std::size_t>(disparities_);
  find_control_points(costs.data());
  std::copy_n(costs.begin(), count, match_.begin() + 1);
  std::fill(occlusion_.begin(), occlusion_.end(), kNever);
  MoveCosts move_costs{units(options_.step_down), units(options_.step_up), 0, units(options_.occluded)};
  for (std::size_t x = 1; x < static_cast<std::size_t>(width_); ++x) {
    const int contrast = std::abs(grey[x] - grey[x - 1]);
    move_costs.jump = jump_cost_[static_cast<std::size_t>(contrast)];
    step(costs.data() + x * count, move_costs, control_[x], moves_.data() + x * count);
  }
  walk_back(costs.data(), disparity_px, occluded);
}

}  // namespace palpable::vision
