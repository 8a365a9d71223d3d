// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::models {

/// From the sample below a ball's centre to the one that the ball touches, samples.
struct ContactOffset {
  int right = 0;
  int down = 0;
};

/// Where a ball that is lowered onto samples touches them: at the sample q for which heights(q) +
/// sqrt(reach^2
/// - |q - p|^2) is greatest, p being the sample below the centre. Samples beyond the border have the height
/// of the nearest one. Immutable; any thread.
class BallContacts {
 public:
  /// Heights and `reach`, the ball's radius (> 0), in sample distances. `heights` must outlive the object.
  BallContacts(const Raster<float>& heights, double reach);

  /// The contacts of the row `y`; `found` has one element per column. Small balls try each sample below them.
  /// Large ones leave out blocks of samples that are too low, which takes little more time than a small ball.
  void find_row(int y, std::span<ContactOffset> found) const;

 private:
  /// The highest sample in each block of `side` x `side` samples.
  struct Level {
    int side = 1;
    Raster<float> highest;
  };
  struct Search {
    int x = 0;
    int y = 0;
    /// The lowest point of the ball.
    float best = 0.0F;
    ContactOffset at;
  };
  void try_each(int y, std::span<ContactOffset> found) const;
  void descend(std::size_t level, int i, int j, Search& search) const;
  const Raster<float>& highest(std::size_t level) const {
    return level == 0 ? heights_ : levels_[level - 1].highest;
  }

  const Raster<float>& heights_;
  double reach_;
  bool is_small_;
  /// Each of blocks of blocks of the one before; none for a small ball.
  std::vector<Level> levels_;
};

}  // namespace palpable::models
