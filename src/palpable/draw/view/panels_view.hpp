// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/draw/canvas/figure.hpp"
#include "palpable/draw/canvas/figure_title.hpp"

#include <string>
#include <variant>
#include <vector>

namespace palpable::draw {

/// One of several maps side by side.
struct Panel {
  std::string name;
  /// A line of text below it.
  std::string caption;
  /// A picture, or a map of disparities in pixels, unknown = not finite (hatched).
  std::variant<Raster<Rgb8>, Raster<float>> content;
};

/// All panels at one size, three per row. The maps share one colour scale (pale is near) over the display
/// range of the first map. At least one panel.
Figure panels_figure(std::vector<Panel> panels, const FigureTitle& title);

}  // namespace palpable::draw
