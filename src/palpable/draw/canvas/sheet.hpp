// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/canvas/figure_title.hpp"
#include "palpable/draw/canvas/plot.hpp"

#include <string>

namespace palpable::draw {

/// The layout of a page with one plot: title above, legend on the right, caption below.
struct Sheet {
  int width_px = 0;
  int height_px = 0;
  Rect plot;
  /// The colour bar; its text has room up to the page's right edge.
  Rect bar;
  Rect caption;
};

/// The layout for a plot of this ratio of width to height, clamped to 1:3 … 3:1.
Sheet sheet_for(double aspect);

/// Draws title and subtitle from `left_px` on.
void draw_title(Canvas& canvas, const FigureTitle& title, double left_px, double width_px);

/// Draws a title and a caption.
void draw_title_and_caption(Canvas& canvas, const Sheet& sheet, const FigureTitle& title,
                            const std::string& caption);

}  // namespace palpable::draw
