// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"

#include <string>
#include <vector>

namespace palpable::draw {

/// One value over time, with the title of its plot.
struct Trace {
  std::string title;
  /// One per `period_s`.
  std::vector<double> values;
  double period_s = 0.001;
};

/// Small plots side by side, `columns` (at least 1) per row, all with the same scale, symmetric about 0.
/// `value_name` with its unit labels the first plot of each row.
Figure traces_figure(std::vector<Trace> traces, int columns, const std::string& value_name,
                     const FigureTitle& title);

}  // namespace palpable::draw
