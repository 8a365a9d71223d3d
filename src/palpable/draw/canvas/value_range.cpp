// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/value_range.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <cmath>
#include <vector>

namespace palpable::draw {

std::pair<float, float> display_range(const Raster<float>& values) {
  std::vector<float> known;
  known.reserve(values.count());
  for (const float v : values.values())
    if (std::isfinite(v)) known.push_back(v);
  if (known.empty()) return {0.0F, 1.0F};
  const float low = quantile_of(known, 0.005), high = quantile_of(known, 0.995);
  return high > low ? std::pair{low, high} : std::pair{low - 0.5F, low + 0.5F};
}

}  // namespace palpable::draw
