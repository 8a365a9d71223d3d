// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/path_costs.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <utility>

namespace palpable::vision {
namespace {

/// Guard values before the first and after the last disparity of each pixel, above every path cost.
constexpr int kGuard = 32;
constexpr std::uint8_t kGuardCost = 255;

/// One pixel of one path. `before` has a guard on each side. Sets `path` to the path costs minus their
/// minimum.
template <SumState kState>
[[gnu::always_inline]] inline void advance(const std::uint8_t* __restrict cost,
                                           const std::uint8_t* __restrict before, std::uint8_t large_step,
                                           int small_step_share, int count, std::uint8_t* __restrict path,
                                           std::uint16_t* __restrict sum) {
  const auto small_step = static_cast<std::uint8_t>(large_step * small_step_share / 256);
  std::uint8_t least = 255;
  for (int d = 0; d < count; ++d) {
    const std::uint8_t lower = before[d - 1];
    const std::uint8_t higher = before[d + 1];
    std::uint8_t beside = lower < higher ? lower : higher;
    // Truncated first, so that the sum fits.
    beside = beside < large_step ? beside : large_step;
    const auto shifted = static_cast<std::uint8_t>(beside + small_step);
    std::uint8_t best = before[d] < large_step ? before[d] : large_step;
    best = shifted < best ? shifted : best;
    const auto value = static_cast<std::uint8_t>(cost[d] + best);
    path[d] = value;
    least = value < least ? value : least;
  }
  for (int d = 0; d < count; ++d) {
    const auto value = static_cast<std::uint8_t>(path[d] - least);
    path[d] = value;
    sum[d] = kState == SumState::begins ? value : static_cast<std::uint16_t>(sum[d] + value);
  }
}

PALPABLE_VECTORIZE void advance_row(const std::uint8_t* cost, const std::uint8_t* steps_from_left, int width,
                                    int stride, int small_step_share, int direction, std::uint8_t* before,
                                    std::uint8_t* next, std::uint16_t* sum) {
  for (int n = 0; n < width; ++n) {
    const int x = direction > 0 ? n : width - 1 - n;
    const std::uint8_t step = n == 0 ? std::uint8_t{0} : steps_from_left[direction > 0 ? x : x + 1];
    const std::ptrdiff_t at = std::ptrdiff_t{x} * stride;
    advance<SumState::continues>(cost + at, before, step, small_step_share, stride, next, sum + at);
    std::swap(before, next);
  }
}

/// One of the three paths between rows: its costs in the previous row, already shifted for its direction, and
/// in this row.
struct Lane {
  const std::uint8_t* steps;
  const std::uint8_t* before;
  std::uint8_t* here;
};

PALPABLE_VECTORIZE void advance_columns(const std::uint8_t* cost, const std::array<Lane, 3>& lanes, int width,
                                        int stride, int small_step_share, int pitch, SumState state,
                                        std::uint16_t* sum) {
  for (int x = 0; x < width; ++x) {
    const std::ptrdiff_t at = std::ptrdiff_t{x} * stride;
    const std::ptrdiff_t from = std::ptrdiff_t{x} * pitch;
    const auto& [slanted, straight, other_way] = lanes;
    if (state == SumState::begins)
      advance<SumState::begins>(cost + at, slanted.before + from, slanted.steps[x], small_step_share, stride,
                                slanted.here + from, sum + at);
    else
      advance<SumState::continues>(cost + at, slanted.before + from, slanted.steps[x], small_step_share,
                                   stride, slanted.here + from, sum + at);
    for (const Lane& lane : {straight, other_way})
      advance<SumState::continues>(cost + at, lane.before + from, lane.steps[x], small_step_share, stride,
                                   lane.here + from, sum + at);
  }
}

}  // namespace

RowPaths::RowPaths(int stride, int small_step_share) : stride_(stride), small_step_share_(small_step_share) {
  for (auto& path : path_) path.assign(static_cast<std::size_t>(stride + 2 * kGuard), kGuardCost);
}

void RowPaths::add(const std::uint8_t* cost, const std::vector<std::uint8_t>& steps_from_left,
                   std::uint16_t* sum) {
  const int width = static_cast<int>(steps_from_left.size());
  for (const int direction : {1, -1}) {
    std::fill_n(path_[0].begin() + kGuard, stride_, std::uint8_t{0});
    advance_row(cost, steps_from_left.data(), width, stride_, small_step_share_, direction,
                path_[0].data() + kGuard, path_[1].data() + kGuard, sum);
  }
}

ColumnPaths::ColumnPaths(int width, int stride, int small_step_share)
    : width_(width), stride_(stride), small_step_share_(small_step_share) {
  // One more pixel on each side, where diagonal paths begin: there all disparities cost the same.
  for (Row* row : {&before_, &here_})
    for (auto* path : {&row->from_left, &row->straight, &row->from_right})
      path->assign(at(width + 1), kGuardCost);
}

std::size_t ColumnPaths::at(int x) const {
  return static_cast<std::size_t>(x + 1) * static_cast<std::size_t>(stride_ + kGuard) + kGuard;
}

void ColumnPaths::add(const std::uint8_t* cost, const RowSteps& steps, SumState state, std::uint16_t* sum) {
  advance_columns(
      cost,
      {Lane{steps.before_left.data(), before_.from_left.data() + at(-1), here_.from_left.data() + at(0)},
       Lane{steps.before.data(), before_.straight.data() + at(0), here_.straight.data() + at(0)},
       Lane{steps.before_right.data(), before_.from_right.data() + at(1), here_.from_right.data() + at(0)}},
      width_, stride_, small_step_share_, stride_ + kGuard, state, sum);
  std::swap(before_, here_);
}

}  // namespace palpable::vision
