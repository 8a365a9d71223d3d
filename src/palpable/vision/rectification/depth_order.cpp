// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/depth_order.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palpable::vision {

double order_agreement(const PointDepths& depths, const std::vector<double>& other) {
  PALPABLE_CHECK(depths.nearness.size() == other.size() && depths.uncertainty.size() == other.size());
  constexpr std::size_t kMostPoints = 300;
  const std::size_t stride = std::max<std::size_t>(1, (other.size() + kMostPoints - 1) / kMostPoints);
  double agreeing = 0.0, clear = 0.0;
  for (std::size_t i = 0; i < other.size(); i += stride)
    for (std::size_t j = 0; j < i; j += stride) {
      const double by = depths.nearness[i] - depths.nearness[j];
      if (!(std::abs(by) > std::hypot(depths.uncertainty[i], depths.uncertainty[j]))) continue;
      clear += 1.0;
      const double too = other[i] - other[j];
      if (too != 0.0) agreeing += (too > 0.0) == (by > 0.0) ? 1.0 : -1.0;
    }
  return clear > 0.0 ? agreeing / clear : 0.0;
}

}  // namespace palpable::vision
