// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/draw/canvas/canvas.hpp"

#include <string>
#include <vector>

namespace palpable::draw {

/// Millimetres in a metre: figures are labelled in millimetres.
inline constexpr double kMm = 1000.0;

/// Tick values in [low, high] at a spacing of 1, 2 or 5 times a power of ten, at most `most` of them.
std::vector<double> round_ticks(double low, double high, int most);

/// A number as a label, with the decimals that ticks of spacing `step` need and a Unicode minus sign.
std::string label_of(double value, double step);

/// The mapping from a range of values to a rectangle of the figure; y grows upwards.
struct Plot {
  Rect area;
  double left = 0, right = 1, bottom = 0, top = 1;

  double x(double value) const { return area.x + (value - left) / (right - left) * area.width; }
  double y(double value) const { return area.bottom() - (value - bottom) / (top - bottom) * area.height; }
  CanvasPoint at(double value_x, double value_y) const { return {x(value_x), y(value_y)}; }
};

/// Draws the frame, the ticks with labels, and the names of the axes (with units) left and below.
void draw_axes(Canvas& canvas, const Plot& plot, const std::string& x_name, const std::string& y_name);

/// A vertical colour bar from `low` (bottom) to `high`, with labelled ticks on its right and its name above.
/// `colour` takes 0…1.
void draw_colour_bar(Canvas& canvas, Rect area, double low, double high, const std::string& name,
                     Rgb8 (*colour)(double));

/// A scale bar in the plot's lower left corner: a round length of about a fifth of the plot's width. The
/// plot's values are millimetres.
void draw_scale_bar(Canvas& canvas, const Plot& plot);

}  // namespace palpable::draw
