// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/scanline_path.hpp"

#include "palpable/core/vectorize.hpp"
#include "palpable/vision/sub_pixel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palpable::vision {
namespace {

constexpr float kNever = 1e9F;

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
PALPABLE_VECTORIZE void advance(const float* match, const float* occlusion, const float* above,
                                const float* costs, int count, float step_down, float step_up, float jump,
                                float occluded, float* match_next, float* occlusion_next,
                                std::uint8_t* moves) {
  for (int d = 0; d < count; ++d) {
    const float here = match[d + 1];
    const float higher = match[d + 2] + step_down;
    const float lower = match[d] + step_up;
    const float jumped = above[d + 1] + jump;
    const float hidden = occlusion[d + 1];
    float best = here;
    int move = stay;
    move = higher < best ? step_from_above : move;
    best = std::min(best, higher);
    move = lower < best ? step_from_below : move;
    best = std::min(best, lower);
    move = jumped < best ? jump_down : move;
    best = std::min(best, jumped);
    move = hidden < best ? end_of_occlusion : move;
    best = std::min(best, hidden);
    match_next[d + 1] = best + costs[d];
    move |= above[d + 1] < match[d + 2] ? kJumpFromHigher : 0;
    const float begins = match[d] + jump;
    const float goes_on = occlusion[d];
    move |= goes_on < begins ? kOcclusionGoesOn : 0;
    occlusion_next[d + 1] = std::min(begins, goes_on) + occluded;
    moves[d] = static_cast<std::uint8_t>(move);
  }
}

}  // namespace

ScanlinePath::ScanlinePath(int width, int disparities, const PathOptions& options)
    : width_(width), disparities_(disparities), options_(options) {
  const auto columns = static_cast<std::size_t>(width);
  const auto padded = static_cast<std::size_t>(disparities) + 2;
  control_.resize(columns);
  right_best_.resize(columns);
  right_cost_.resize(columns);
  for (auto* v : {&match_, &match_next_, &occlusion_, &occlusion_next_, &from_above_})
    v->assign(padded, kNever);
  moves_.resize(columns * static_cast<std::size_t>(disparities));
}

void ScanlinePath::find_control_points(const float* costs) {
  std::fill(right_cost_.begin(), right_cost_.end(), kNever);
  for (int x = 0; x < width_; ++x) {
    const float* c = costs + static_cast<std::size_t>(x) * static_cast<std::size_t>(disparities_);
    const int visible = std::min(disparities_, x + 1);
    for (int d = 0; d < visible; ++d) {
      const auto right = static_cast<std::size_t>(x - d);
      if (c[d] < right_cost_[right]) {
        right_cost_[right] = c[d];
        right_best_[right] = x;
      }
    }
    const int best = static_cast<int>(std::min_element(c, c + disparities_) - c);
    float second = kNever;
    for (int d = 0; d < best - 1; ++d) second = std::min(second, c[d]);
    for (int d = best + 2; d < disparities_; ++d) second = std::min(second, c[d]);
    const bool distinct = c[best] < options_.control_cost && second > options_.control_ratio * c[best] + 1.0F;
    control_[static_cast<std::size_t>(x)] = distinct && best <= x ? best : -1;
  }
  for (int x = 0; x < width_; ++x) {
    int& d = control_[static_cast<std::size_t>(x)];
    if (d >= 0 && right_best_[static_cast<std::size_t>(x - d)] != x) d = -1;
  }
}

void ScanlinePath::step(const float* costs, float jump, int control, std::uint8_t* moves) {
  float best = kNever;
  for (int d = disparities_ - 1; d >= 0; --d) {
    const auto i = static_cast<std::size_t>(d);
    best = std::min(best, match_[i + 2]);
    from_above_[i + 1] = best;
  }
  advance(match_.data(), occlusion_.data(), from_above_.data(), costs, disparities_, options_.step_down,
          options_.step_up, jump, options_.occluded, match_next_.data(), occlusion_next_.data(), moves);
  if (control >= 0) {
    for (int d = 0; d < disparities_; ++d)
      if (d != control) match_next_[static_cast<std::size_t>(d) + 1] += options_.control;
  }
  match_.swap(match_next_);
  occlusion_.swap(occlusion_next_);
}

void ScanlinePath::walk_back(const float* costs, std::span<float> disparity_px,
                             std::span<std::uint8_t> occluded) {
  const auto count = static_cast<std::size_t>(disparities_);
  int d = static_cast<int>(std::min_element(match_.begin() + 1, match_.end() - 1) - match_.begin()) - 1;
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

void ScanlinePath::find(std::span<const float> costs, std::span<const std::uint8_t> grey,
                        std::span<float> disparity_px, std::span<std::uint8_t> occluded) {
  const auto count = static_cast<std::size_t>(disparities_);
  find_control_points(costs.data());
  std::copy_n(costs.begin(), count, match_.begin() + 1);
  std::fill(occlusion_.begin(), occlusion_.end(), kNever);
  for (std::size_t x = 1; x < static_cast<std::size_t>(width_); ++x) {
    const int contrast = std::abs(grey[x] - grey[x - 1]);
    const float jump = options_.jump / (1.0F + static_cast<float>(contrast) / options_.edge_levels);
    step(costs.data() + x * count, jump, control_[x], moves_.data() + x * count);
  }
  walk_back(costs.data(), disparity_px, occluded);
}

}  // namespace palpable::vision
