// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"

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

/// A place in pixels of the figure, x right, y down.
struct Spot {
  double x = 0, y = 0;
};

struct Ink {
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
  /// Turned a quarter to the left about its place (an upright axis's name).
  bool upward = false;
  /// A white rim, to be read over a picture.
  bool rim = false;
};

/// What the views draw with: Cairo's context, and text set by Pango. Borrowed from write_figure(). One
/// thread.
class Canvas {
 public:
  explicit Canvas(cairo_t* context) : context_(context) {}

  void fill(Rect area, Rgb8 colour, double alpha = 1.0);
  void frame(Rect area, Ink ink);
  void line(Spot from, Spot to, Ink ink);
  /// One stroke through all spots.
  void path(std::span<const Spot> spots, Ink ink);
  void polygon(std::span<const Spot> spots, Rgb8 colour, double alpha = 1.0);
  void disc(Spot centre, double radius, Rgb8 colour, double alpha = 1.0);
  /// A shaft with a filled head; shorter than its head: the head alone, smaller. Has a white rim.
  void arrow(Spot from, Spot to, Ink ink);
  /// Scaled to fill `area`, smoothed.
  void picture(const Raster<Rgb8>& pixels, Rect area);
  /// Diagonal lines over light grey: here nothing is known.
  void hatch(Rect area);
  /// Where `mask` (stretched over `area`) is not 0, diagonal lines over light grey.
  void hatch(const Raster<std::uint8_t>& mask, Rect area);

  /// The text's top stands at `at`. Returns its height in pixels.
  double text(std::string_view utf8, Spot at, const TextStyle& style);
  /// Width and height that text() would take.
  Spot text_size(std::string_view utf8, const TextStyle& style);

 private:
  void ink(Ink ink);
  cairo_t* context_;
};

}  // namespace palpable::draw
