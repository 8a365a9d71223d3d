// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/numbers/rank_correlation.hpp"
#include "palpable/core/picture/raster.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace palpable::bench {

/// Rank correlation of disparities with the true ones, of the pixels where both are known; 0 where the sizes
/// differ or hardly any pixel is known.
inline double depth_rank(const Raster<float>& found, const Raster<float>& truth) {
  if (found.width() != truth.width() || found.height() != truth.height()) return 0.0;
  std::vector<float> a, b;
  for (std::size_t i = 0; i < found.count(); ++i)
    if (std::isfinite(found.values()[i]) && truth.values()[i] > 0.0F) {
      a.push_back(found.values()[i]);
      b.push_back(truth.values()[i]);
    }
  return a.size() < 10 ? 0.0 : rank_correlation(a, b);
}

}  // namespace palpable::bench
