// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::vision {

/// Semi-global path costs (Hirschmueller 2008, eq. 13) in 8 bits, row by row, so that data stay in the cache
/// and loops are vectorised. Costs of a row are cost[x * stride + d], stride a multiple of 32; matching costs
/// up to kLargestCost and steps up to kLargestStep. The penalty of a step of one disparity is given in 256ths
/// of that of a larger step.
inline constexpr int kLargestCost = 127;
inline constexpr int kLargestStep = 127;

/// The penalties of steps of more than one disparity between the pixels of a row and their neighbours in the
/// previous row.
struct RowSteps {
  std::vector<std::uint8_t> before_left, before, before_right;
  explicit RowSteps(int width)
      : before_left(static_cast<std::size_t>(width)), before(before_left), before_right(before_left) {}
};

/// Whether path costs are the first of a sum or are added to it.
enum class SumState { begins, continues };

/// The two paths along a row: adds their costs to `sum`. steps_from_left[x] leads from x - 1 to x.
class RowPaths {
 public:
  RowPaths(int stride, int small_step_share);
  void add(const std::uint8_t* cost, const std::vector<std::uint8_t>& steps_from_left, std::uint16_t* sum);

 private:
  int stride_;
  int small_step_share_;
  std::array<std::vector<std::uint8_t>, 2> path_;
};

/// The three paths from row to row, vertical and diagonal, in either order of rows.
class ColumnPaths {
 public:
  ColumnPaths(int width, int stride, int small_step_share);
  /// Processes the next row; the first one begins the paths. Adds the path costs to `sum`, or overwrites it
  /// if it begins.
  void add(const std::uint8_t* cost, const RowSteps& steps, SumState state, std::uint16_t* sum);

 private:
  std::size_t at(int x) const;

  int width_;
  int stride_;
  int small_step_share_;
  /// Path costs minus their minimum, between guards.
  struct Row {
    std::vector<std::uint8_t> from_left, straight, from_right;
  };
  Row before_, here_;
};

}  // namespace palpable::vision
