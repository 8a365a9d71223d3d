// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <cstdint>
#include <span>
#include <string_view>

#include <cairo.h>

namespace palpable::draw {

struct Rect {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

/// A position on the figure, in pixels: x right, y down.
struct CanvasPoint {
  double x = 0, y = 0;
};

struct StrokeStyle {
  Rgb8 colour{26, 26, 26};
  double width = 1.0;
  double alpha = 1.0;
};

enum class Align { left, centre, right };

struct TextStyle {
  double size_px = 14.0;
  bool bold = false;
  Align align = Align::left;
  Rgb8 colour{26, 26, 26};
  /// Lines are broken at words beyond this width; 0 = never.
  double wrap_px = 0.0;
  /// Rotated by 90 degrees counter-clockwise about its position, for the name of a vertical axis.
  bool upward = false;
  /// A white outline, so that the text can be read over a picture.
  bool rim = false;
};

/// Drawing operations for the views: a Cairo context, and text laid out by Pango. Valid only inside
/// Figure::paint(). One thread.
class Canvas {
 public:
  explicit Canvas(cairo_t* context) : context_(context) {}

  void fill(Rect area, Rgb8 colour, double alpha = 1.0);
  void frame(Rect area, StrokeStyle style);
  void line(CanvasPoint from, CanvasPoint to, StrokeStyle style);
  /// One line through all points.
  void path(std::span<const CanvasPoint> points, StrokeStyle style);
  void polygon(std::span<const CanvasPoint> points, Rgb8 colour, double alpha = 1.0);
  void disc(CanvasPoint centre, double radius, Rgb8 colour, double alpha = 1.0);
  /// A shaft with a filled head and a white outline. An arrow shorter than its head is drawn as a smaller
  /// head alone.
  void arrow(CanvasPoint from, CanvasPoint to, StrokeStyle style);
  /// Scaled to fill `area`, smoothed.
  void picture(const Raster<Rgb8>& pixels, Rect area);
  /// Diagonal lines over light grey, which mark unknown values.
  void hatch(Rect area);
  /// The same only where `mask`, stretched over `area`, is not 0.
  void hatch(const Raster<std::uint8_t>& mask, Rect area);

  /// `at` is the top of the text. Returns the text's height in pixels.
  double text(std::string_view utf8, CanvasPoint at, const TextStyle& style);
  /// Width and height of the text as text() would draw it.
  CanvasPoint text_size(std::string_view utf8, const TextStyle& style);

 private:
  void set_stroke(StrokeStyle style);
  cairo_t* context_;
};

}  // namespace palpable::draw
