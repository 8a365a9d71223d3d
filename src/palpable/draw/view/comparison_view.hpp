// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"
#include "palpable/models/relief/relief.hpp"

#include <string>
#include <vector>

namespace palpable::draw {

/// One of several reliefs shown side by side, with a few short lines of text below it.
struct ComparedRelief {
  std::string name;
  models::Relief relief;
  std::vector<std::string> lines;
};

/// Reliefs side by side, three per row, each tinted by height and shaded as in relief_figure(). At least one.
Figure comparison_figure(std::vector<ComparedRelief> reliefs, const FigureTitle& title);

}  // namespace palpable::draw
