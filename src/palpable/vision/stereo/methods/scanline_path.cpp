// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/scanline_path.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/stereo/cost/cross_window.hpp"
#include "palpable/vision/stereo/cost/least_cost.hpp"
#include "palpable/vision/stereo/cost/sub_pixel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palpable::vision {
namespace {

using Cost = std::uint16_t;

/// Limit of path costs, which are stored minus the minimum of their column: no overflow when a move and a
/// matching cost are added, and above the cost of a jump of 300 pixels.
constexpr Cost kNever = 64000;
/// Divisor of matching costs in path costs.
constexpr int kFiner = 4;

// How a cell was reached, three bits; and two flags.
enum Move : std::uint8_t {
  stay = 0,
  step_from_above = 1,
  step_from_below = 2,
  jump_down = 3,
  end_of_occlusion = 4
};
constexpr std::uint8_t kMoveBits = 7;
constexpr std::uint8_t kJumpFromHigher = 8;    // a jump to this cell begins above the next disparity
constexpr std::uint8_t kOcclusionGoesOn = 16;  // the pixel before was occluded too

[[gnu::always_inline]] inline Cost least_of(Cost a, Cost b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Cost sum_of(Cost a, Cost b) { return static_cast<Cost>(a + b); }

/// All arrays are padded by one kNever cell at both ends: index d + 1 is disparity d. `base` is subtracted
/// from all path costs; returns the minimum of the result.
PALPABLE_VECTORIZE Cost advance(const Cost* __restrict match, const Cost* __restrict occlusion,
                                const Cost* __restrict above, const Cost* __restrict costs, int count,
                                ScanlinePath::MoveCosts move_costs, Cost base, Cost* __restrict match_next,
                                Cost* __restrict occlusion_next, Cost* __restrict moves) {
  Cost least_left = kNever;
  for (int d = 0; d < count; ++d) {
    const Cost higher = sum_of(match[d + 2], move_costs.step_down);
    const Cost lower = sum_of(match[d], move_costs.step_up);
    const Cost jumped = sum_of(above[d], move_costs.jump);
    const Cost hidden = occlusion[d + 1];
    Cost best = match[d + 1];
    Cost move = stay;
    move = higher < best ? Cost{step_from_above} : move;
    best = least_of(higher, best);
    move = lower < best ? Cost{step_from_below} : move;
    best = least_of(lower, best);
    move = jumped < best ? Cost{jump_down} : move;
    best = least_of(jumped, best);
    move = hidden < best ? Cost{end_of_occlusion} : move;
    best = least_of(hidden, best);
    const Cost reached = least_of(static_cast<Cost>(best + costs[d] / kFiner - base), kNever);
    match_next[d + 1] = reached;
    const Cost from_higher = above[d] < match[d + 2] ? Cost{kJumpFromHigher} : Cost{0};
    const Cost begins = sum_of(match[d], move_costs.jump);
    const Cost goes_on = occlusion[d];
    const Cost on = goes_on < begins ? Cost{kOcclusionGoesOn} : Cost{0};
    const Cost unseen =
        least_of(static_cast<Cost>(least_of(goes_on, begins) + move_costs.occluded - base), kNever);
    occlusion_next[d + 1] = unseen;
    moves[d] = static_cast<Cost>(move | from_higher | on);
    least_left = least_of(least_left, least_of(reached, unseen));
  }
  return least_left;
}

PALPABLE_VECTORIZE void narrow(const Cost* __restrict from, int count, std::uint8_t* __restrict to) {
  for (int d = 0; d < count; ++d) to[d] = static_cast<std::uint8_t>(from[d]);
}

/// The minimum of match[d + 1], match[d + 2] … at each d, by doubling the reach, so that it is vectorised.
/// All have 2 * count cells, those from `count` on kNever. Returns which of the two scratch rows holds it.
PALPABLE_VECTORIZE const Cost* least_above(const Cost* match, int count, Cost* scratch, Cost* other) {
  const Cost* from = match + 1;
  for (int reach = 1; reach < count; reach *= 2) {
    Cost* const to = scratch;
    PALPABLE_INDEPENDENT
    for (int d = 0; d < count; ++d) to[d] = from[d] < from[d + reach] ? from[d] : from[d + reach];
    from = to;
    scratch = other;
    other = to;
  }
  return from;
}

PALPABLE_VECTORIZE void add_to_all(Cost* costs, Cost more, int count) {
  for (int d = 0; d < count; ++d) costs[d] = least_of(sum_of(costs[d], more), kNever);
}

/// In units of the matching costs, and in those of path costs.
int units(float matching_costs) { return static_cast<int>(std::lround(kMeanCostUnit * matching_costs)); }
Cost path_units(float matching_costs) { return static_cast<Cost>(units(matching_costs) / kFiner); }

}  // namespace

std::vector<Parameter> parameters_of(PathOptions& o) {
  return {{"step_down", &o.step_down, {0, 200}, "cost", "Step of one disparity down"},
          {"step_up", &o.step_up, {0, 200}, "cost", "Step of one disparity up"},
          {"jump", &o.jump, {0, 200}, "cost", "Jump between pixels of one brightness"},
          {"edge_levels",
           &o.edge_levels,
           {0.1, 255},
           "levels",
           "Difference in brightness that halves a jump's cost"},
          {"occluded", &o.occluded, {0, 200}, "cost", "A pixel that is occluded in the right picture"},
          {"control_cost", &o.control_cost, {0, 144}, "cost", "Largest cost of a ground control point"},
          {"control_ratio", &o.control_ratio, {1, 100}, "", "All other disparities cost more by this factor"},
          {"control", &o.control, {0, 200}, "cost", "Leaving a ground control point"}};
}

ScanlinePath::ScanlinePath(int width, int disparities, int stride, const PathOptions& options)
    : width_(width), disparities_(disparities), stride_(stride), options_(options) {
  const auto columns = static_cast<std::size_t>(width);
  const auto padded = 2 * static_cast<std::size_t>(stride) + 2;
  control_.resize(columns);
  right_best_.resize(columns + static_cast<std::size_t>(stride));
  right_cost_.resize(right_best_.size());
  for (auto* v : {&match_, &match_next_, &occlusion_, &occlusion_next_, &above_, &above_too_})
    v->assign(padded, kNever);
  for (std::size_t contrast = 0; contrast < jump_cost_.size(); ++contrast)
    jump_cost_[contrast] =
        path_units(options.jump / (1.0F + static_cast<float>(contrast) / options.edge_levels));
  wide_moves_.resize(static_cast<std::size_t>(stride));
  moves_.resize(columns * wide_moves_.size());
}

void ScanlinePath::find_control_points(const Cost* costs) {
  // The right picture's columns are stored from right to left, so that the index increases with d.
  std::fill(right_cost_.begin(), right_cost_.end(), Cost{65535});
  const int control_cost = units(options_.control_cost);
  for (int x = 0; x < width_; ++x) {
    const Cost* c = costs + static_cast<std::size_t>(x) * static_cast<std::size_t>(stride_);
    const auto first = static_cast<std::size_t>(width_ - 1 - x);
    keep_least(c, static_cast<Cost>(x), stride_, right_cost_.data() + first, right_best_.data() + first);
    const LeastCost least = least_cost(c, stride_);
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

void ScanlinePath::step(const Cost* costs, const MoveCosts& move_costs, int control, std::uint8_t* moves) {
  const Cost* above = least_above(match_.data() + 1, stride_, above_.data(), above_too_.data());
  const Cost least = advance(match_.data(), occlusion_.data(), above, costs, stride_, move_costs, base_,
                             match_next_.data(), occlusion_next_.data(), wide_moves_.data());
  narrow(wide_moves_.data(), stride_, moves);
  if (control >= 0) {
    const Cost leaving = path_units(options_.control);
    Cost& here = match_next_[static_cast<std::size_t>(control) + 1];
    const Cost unchanged = here;
    add_to_all(match_next_.data() + 1, leaving, stride_);
    here = unchanged;
  }
  base_ = least;
  match_.swap(match_next_);
  occlusion_.swap(occlusion_next_);
}

void ScanlinePath::walk_back(const Cost* costs, std::span<float> disparity_px,
                             std::span<std::uint8_t> occluded) {
  const auto count = static_cast<std::size_t>(stride_);
  int d = static_cast<int>(std::min_element(match_.begin() + 1, match_.begin() + 1 + disparities_) -
                           match_.begin()) -
          1;
  bool hidden = false;
  for (int x = width_ - 1; x >= 0; --x) {
    const auto column = static_cast<std::size_t>(x);
    occluded[column] = hidden ? 1 : 0;
    const int inside = std::min(d, disparities_ - 1);
    disparity_px[column] =
        static_cast<float>(inside) + sub_pixel_offset(costs + column * count, inside, disparities_);
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
  // Pixels that only the left camera sees are behind: they take the disparity of the surface at their left.
  for (std::size_t x = 1; x < disparity_px.size(); ++x)
    if (occluded[x] != 0) disparity_px[x] = disparity_px[x - 1];
}

void ScanlinePath::find(std::span<const Cost> costs, std::span<const std::uint8_t> grey,
                        std::span<float> disparity_px, std::span<std::uint8_t> occluded) {
  const auto count = static_cast<std::size_t>(stride_);
  find_control_points(costs.data());
  std::transform(costs.begin(), costs.begin() + stride_, match_.begin() + 1,
                 [](Cost cost) { return static_cast<Cost>(cost / kFiner); });
  base_ = 0;
  std::fill(occlusion_.begin(), occlusion_.end(), kNever);
  MoveCosts move_costs{path_units(options_.step_down), path_units(options_.step_up), 0,
                       path_units(options_.occluded)};
  for (std::size_t x = 1; x < static_cast<std::size_t>(width_); ++x) {
    const int contrast = std::abs(grey[x] - grey[x - 1]);
    move_costs.jump = jump_cost_[static_cast<std::size_t>(contrast)];
    step(costs.data() + x * count, move_costs, control_[x], moves_.data() + x * count);
  }
  walk_back(costs.data(), disparity_px, occluded);
}

}  // namespace palpable::vision
