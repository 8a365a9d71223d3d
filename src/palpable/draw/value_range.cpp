// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/value_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace palpable::draw {

std::pair<float, float> usual_range(const Raster<float>& values) {
  std::vector<float> known;
  known.reserve(values.count());
  for (const float v : values.values())
    if (std::isfinite(v)) known.push_back(v);
  if (known.empty()) return {0.0F, 1.0F};
  const auto quantile = [&known](double q) {
    const auto k = static_cast<std::ptrdiff_t>(q * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), known.begin() + k, known.end());
    return known[static_cast<std::size_t>(k)];
  };
  const float low = quantile(0.005), high = quantile(0.995);
  return high > low ? std::pair{low, high} : std::pair{low - 0.5F, low + 0.5F};
}

}  // namespace palpable::draw
