// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace palpable {

/// The middle value; the upper one of the two if their number is even. `values` must not be empty or contain
/// NaN.
template <class T>
T median_of(std::vector<T> values) {
  PALPABLE_CHECK(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace palpable
