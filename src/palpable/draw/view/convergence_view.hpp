// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"

#include <string>
#include <vector>

namespace palpable::draw {

/// The error after each step of a refinement. Steps of one phase share a colour.
struct ConvergenceView {
  struct Step {
    /// An index into `phases`.
    std::size_t phase = 0;
    /// mm.
    double error = 0.0;
    /// A step that was not taken is drawn as a grey dot; the line stays at the error before it.
    bool taken = true;
  };
  std::vector<std::string> phases;
  std::vector<Step> steps;
};
Figure convergence_figure(ConvergenceView view, const FigureTitle& title);

}  // namespace palpable::draw
