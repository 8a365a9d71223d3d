// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/heading.hpp"
#include "palpable/draw/plot.hpp"

#include <string>

namespace palpable::draw {

/// Where things stand on a page with one plot: heading above, legend on the right, a caption below.
struct Sheet {
  int width_px = 0;
  int height_px = 0;
  Rect plot;
  /// The colour bar's place; text beside and below it has room to the page's edge.
  Rect bar;
  Rect caption;
};

/// A sheet whose plot has this ratio of width to height (clamped to 1:3 … 3:1).
Sheet sheet_for(double aspect);

/// A page's heading, from its left edge on.
void draw_heading(Canvas& canvas, const Heading& heading, double left_px, double width_px);

/// Heading and caption in their places.
void draw_words(Canvas& canvas, const Sheet& sheet, const Heading& heading, const std::string& caption);

}  // namespace palpable::draw
