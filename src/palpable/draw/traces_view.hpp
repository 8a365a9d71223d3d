// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/figure.hpp"
#include "palpable/draw/heading.hpp"

#include <string>
#include <vector>

namespace palpable::draw {

/// One value over time, and what stands above its plot.
struct Trace {
  std::string title;
  /// One each `period_s`.
  std::vector<double> values;
  double period_s = 0.001;
};

/// Small plots side by side, `columns` (at least 1) in a row, all with the same scale, which is symmetric
/// about 0. `value_name` with its unit stands at each row's beginning.
Figure traces_figure(std::vector<Trace> traces, int columns, const std::string& value_name,
                     const Heading& heading);

}  // namespace palpable::draw
