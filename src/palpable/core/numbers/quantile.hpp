// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace palpable {

/// The `at` quantile (0 ... 1) of the values: one of them, without interpolation; the lower one if the
/// position is between two. Reorders `values`, which must not be empty or contain NaN.
template <class T>
T quantile_of(std::vector<T>& values, double at) {
  PALPABLE_CHECK(!values.empty() && at >= 0.0 && at <= 1.0);
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(at * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace palpable
