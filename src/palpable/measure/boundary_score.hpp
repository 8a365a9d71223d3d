// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <vector>

namespace palpable::measure {

struct BoundaryScoreOptions {
  /// A boundary pixel counts as found within this share of the picture's diagonal (0.75 % as the Berkeley
  /// benchmark).
  double tolerance_of_diagonal = 0.0075;
  /// Strengths from which a pixel counts as boundary; each gives one point of the curve. Ascending, in (0,
  /// 1].
  std::vector<double> thresholds;
};

/// Counts at one threshold. Those of a set of pictures are added before precision and recall are computed.
struct BoundaryCounts {
  double threshold = 0.0;
  std::int64_t found = 0;
  std::int64_t found_true = 0;
  std::int64_t wanted = 0;
  std::int64_t wanted_found = 0;

  double precision() const {
    return found > 0 ? static_cast<double>(found_true) / static_cast<double>(found) : 0.0;
  }
  double recall() const {
    return wanted > 0 ? static_cast<double>(wanted_found) / static_cast<double>(wanted) : 0.0;
  }
  /// Harmonic mean of both; 0 where both are 0.
  double f_measure() const;
  BoundaryCounts& operator+=(const BoundaryCounts& other);
};

/// 1 % … 99 % in steps of 2 %.
std::vector<double> usual_thresholds();

/// Compares boundaries one pixel wide (`line`: strength 0 … 1, 0 = none) with boundaries drawn by people (one
/// raster per person, non-zero = boundary), as Martin, Fowlkes and Malik (2004). At each threshold and for
/// each person, found and drawn pixels within the tolerance are paired one to one (maximum bipartite
/// matching). A found pixel is true if it is paired for any person. Errors: sizes that differ, no truth,
/// interrupted.
Result<std::vector<BoundaryCounts>> score_boundary(const Raster<float>& line,
                                                   const std::vector<Raster<std::uint8_t>>& truths,
                                                   const BoundaryScoreOptions& options, const Work& work);

/// The boundary pixels of a labelled picture: those whose right or lower neighbour has another value.
Raster<std::uint8_t> boundary_of_labels(const Raster<float>& labels);

}  // namespace palpable::measure
