// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace palpable {

/// The value below which the fraction `at` (0 … 1) of the values lie: one of them, the lower where the place
/// falls between two. Reorders `values`, which must not be empty and hold no NaN.
template <class T>
T quantile_of(std::vector<T>& values, double at) {
  PALPABLE_CHECK(!values.empty() && at >= 0.0 && at <= 1.0);
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(at * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace palpable
