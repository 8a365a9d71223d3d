// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/marker_sheet.hpp"

#include "palpable/draw/canvas/canvas.hpp"

#include <cmath>

#include <fmt/format.h>

namespace palpable::draw {
namespace {

constexpr double kPxPerMm = 96.0 / 25.4;
constexpr double kPageWidth_mm = 210.0, kPageHeight_mm = 297.0, kMargin_mm = 25.0;
constexpr Rgb8 kBlack{0, 0, 0};

void draw_marker(Canvas& canvas, const Raster<std::uint8_t>& cells, Rect area) {
  canvas.fill(area, kBlack);
  const double cell = area.width / cells.width();
  const auto white = [&](int x, int y) {
    return x < cells.width() && y < cells.height() && cells(x, y) != 0;
  };
  // Neighbours overlap, so that no line shows between them.
  constexpr double kOverlap_px = 0.5;
  for (int y = 0; y < cells.height(); ++y)
    for (int x = 0; x < cells.width(); ++x)
      if (white(x, y))
        canvas.fill({area.x + x * cell, area.y + y * cell, cell + (white(x + 1, y) ? kOverlap_px : 0.0),
                     cell + (white(x, y + 1) ? kOverlap_px : 0.0)},
                    {255, 255, 255});
}

// A ruler with a line for each 10 mm.
void draw_ruler(Canvas& canvas, CanvasPoint at, int length_mm) {
  const StrokeStyle line{kBlack, 1.2};
  canvas.line(at, {at.x + length_mm * kPxPerMm, at.y}, line);
  for (int mm = 0; mm <= length_mm; mm += 10) {
    const double x = at.x + mm * kPxPerMm;
    canvas.line({x, at.y}, {x, at.y + (mm % 50 == 0 ? 14.0 : 8.0)}, line);
    if (mm % 50 == 0)
      canvas.text(fmt::format("{}", mm), {x, at.y + 17.0}, {.size_px = 13.0, .align = Align::centre});
  }
}

}  // namespace

Figure marker_sheet(const Raster<std::uint8_t>& cells, int side_mm) {
  return {static_cast<int>(std::lround(kPageWidth_mm * kPxPerMm)),
          static_cast<int>(std::lround(kPageHeight_mm * kPxPerMm)), [cells, side_mm](Canvas& canvas) {
            const double side = side_mm * kPxPerMm, left = kMargin_mm * kPxPerMm,
                         width = (kPageWidth_mm - 2 * kMargin_mm) * kPxPerMm;
            const double x = (kPageWidth_mm * kPxPerMm - side) / 2;
            double y = kMargin_mm * kPxPerMm;
            draw_marker(canvas, cells, {x, y, side, side});
            y += side + 2 * side / cells.width();
            y += 8 + canvas.text(fmt::format("Marker of {} mm", side_mm), {left, y},
                                 {.size_px = 20.0, .bold = true, .wrap_px = width});
            y += 18 +
                 canvas.text(
                     fmt::format(
                         "Print this page at its own size (100 %), not fitted to the paper. Check it with a "
                         "ruler: each side of the black square must be {} mm long, and the line below "
                         "100 mm.",
                         side_mm),
                     {left, y}, {.size_px = 15.0, .wrap_px = width});
            draw_ruler(canvas, {left, y}, 100);
            y += 52;
            canvas.text(
                "Lay the page flat on the table beside the model, with white paper all around the square. "
                "Keep the "
                "whole square in view in a part of the video. The video then shows how large the model is.",
                {left, y}, {.size_px = 15.0, .wrap_px = width});
          }};
}

}  // namespace palpable::draw
