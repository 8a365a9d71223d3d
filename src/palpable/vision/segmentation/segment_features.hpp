// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace palpable::vision {

/// Lightness, a, b, motion along x and y, height: in units that count as one.
inline constexpr std::size_t kAppearances = 6;

/// What a cell of a frame, or a segment in the mean, looks like, and where it is.
struct SegmentFeature {
  std::array<float, kAppearances> appearance{};
  std::array<float, 2> position{};
};

inline float squared_difference(const SegmentFeature& a, const SegmentFeature& b) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < kAppearances; ++i)
    sum += (a.appearance[i] - b.appearance[i]) * (a.appearance[i] - b.appearance[i]);
  return sum;
}

/// The mean of a segment's cells.
struct SegmentCentre {
  int identity = 0;
  SegmentFeature mean;
  int cells = 0;
};

struct SegmentMergeOptions {
  /// Components with a smaller interior (cells all of whose neighbours belong to it) join a neighbour, cells.
  int least_cells = 1;
  /// Adjacent components that differ less become one.
  double merge_distance = 0.0;
};

/// A frame's cells in connected components.
struct SegmentComponents {
  Raster<int> of_cell;
  /// By the number in of_cell; `identity` is the label of the cells, of the larger part where several joined;
  /// the lower one where they became one for being similar.
  std::vector<SegmentCentre> components;
};

/// Connected components (4 neighbours) of cells with equal labels, merged. Labels below 0 are no identities.
SegmentComponents merged_components(const Raster<int>& labels, const Raster<SegmentFeature>& cells,
                                    const SegmentMergeOptions& options);

}  // namespace palpable::vision
