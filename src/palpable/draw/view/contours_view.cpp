// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/contours_view.hpp"

#include "palpable/draw/canvas/canvas.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::draw {
namespace {

/// White for no boundary, deep blue for the strongest.
Rgb8 line_colour(double strength) {
  const auto mix = [strength](double from, double to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * std::clamp(strength, 0.0, 1.0)));
  };
  return {mix(150, 10), mix(180, 20), mix(230, 110)};
}

/// The picture in pale grey, so that lines stand out; white where there is no picture.
Rgb8 pale_grey(const Raster<Rgb8>& picture, double u, double v) {
  if (picture.empty()) return {255, 255, 255};
  const Rgb8 c = picture(std::min(picture.width() - 1, static_cast<int>(u * picture.width())),
                         std::min(picture.height() - 1, static_cast<int>(v * picture.height())));
  const double luma = 0.299 * c.r + 0.587 * c.g + 0.114 * c.b;
  const auto grey = static_cast<std::uint8_t>(std::lround(165.0 + 90.0 * luma / 255.0));
  return {grey, grey, grey};
}

}  // namespace

Figure contours_figure(Raster<float> lines, Raster<Rgb8> picture, double pixel_m, const FigureTitle& title) {
  const Sheet sheet = sheet_for(static_cast<double>(lines.width()) / lines.height());
  return {sheet.width_px, sheet.height_px,
          [lines = std::move(lines), picture = std::move(picture), pixel_m, title, sheet](Canvas& canvas) {
            Raster<Rgb8> pixels(lines.width(), lines.height());
            for (int y = 0; y < lines.height(); ++y)
              for (int x = 0; x < lines.width(); ++x)
                pixels(x, y) = lines(x, y) > 0.0F ? line_colour(lines(x, y))
                                                  : pale_grey(picture, (x + 0.5) / lines.width(),
                                                              (y + 0.5) / lines.height());
            canvas.picture(pixels, sheet.plot);
            const double half_width = 0.5 * kMm * pixel_m * lines.width(),
                         half_height = 0.5 * kMm * pixel_m * lines.height();
            const Plot plot{sheet.plot, -half_width, half_width, -half_height, half_height};
            draw_axes(canvas, plot, "to the right, mm", "upwards, mm");
            draw_scale_bar(canvas, plot);
            draw_colour_bar(canvas, sheet.bar, 0.0, 1.0, "strength of\nthe boundary", line_colour);
            draw_title_and_caption(canvas, sheet, title,
                                   "Lines that a hand can follow, over the picture they were found in.");
          }};
}

}  // namespace palpable::draw
