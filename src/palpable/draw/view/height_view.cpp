// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/height_view.hpp"

#include "palpable/core/picture/level_lines.hpp"
#include "palpable/draw/canvas/colour_map.hpp"
#include "palpable/draw/canvas/relief_shading.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace palpable::draw {
namespace {

Plot plot_of(const models::Relief& relief, Rect area) {
  const double half_x = 0.5 * kMm * relief.size_x_m(), half_y = 0.5 * kMm * relief.size_y_m();
  return {area, -half_x, half_x, -half_y, half_y};
}

/// Evaluates the surface at every pixel of the plot; the relief's samples are only its control values.
/// `colour` takes a sample and its fractions of the plot's width and height.
template <class Colour>
Raster<Rgb8> rendered(const models::Relief& relief, const Plot& plot, Colour colour) {
  Raster<Rgb8> pixels(static_cast<int>(plot.area.width), static_cast<int>(plot.area.height));
  const double step_x = (plot.right - plot.left) / pixels.width(),
               step_y = (plot.top - plot.bottom) / pixels.height();
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      const double x_mm = plot.left + (x + 0.5) * step_x, y_mm = plot.top - (y + 0.5) * step_y;
      pixels(x, y) = colour(relief.sample(x_mm / kMm, y_mm / kMm), (x + 0.5) / pixels.width(),
                            (y + 0.5) / pixels.height());
    }
  }
  return pixels;
}

/// The pixel at fractions of the picture's width and height.
Rgb8 colour_at(const Raster<Rgb8>& picture, double u, double v) {
  return picture(std::min(picture.width() - 1, static_cast<int>(u * picture.width())),
                 std::min(picture.height() - 1, static_cast<int>(v * picture.height())));
}

double position(double value, double low, double high) {
  return high > low ? (value - low) / (high - low) : 0.5;
}

/// Draws the lines of equal height at `level_mm`; the samples of `height_mm` span the plot.
void draw_height_lines(Canvas& canvas, const Plot& plot, const Raster<float>& height_mm, double level_mm,
                       StrokeStyle style) {
  const double cell_x = plot.area.width / (height_mm.width() - 1),
               cell_y = plot.area.height / (height_mm.height() - 1);
  const auto on_canvas = [&](RasterPoint p) {
    return CanvasPoint{plot.area.x + p.x * cell_x, plot.area.y + p.y * cell_y};
  };
  for (const auto& line : level_lines(height_mm, level_mm))
    for (std::size_t i = 1; i < line.size(); ++i)
      canvas.line(on_canvas(line[i - 1]), on_canvas(line[i]), style);
}

double line_step_mm(double low_mm, double high_mm) {
  const auto levels = round_ticks(low_mm, high_mm, 9);
  return levels.size() > 1 ? levels[1] - levels[0] : high_mm - low_mm;
}

void draw_all_height_lines(Canvas& canvas, const models::Relief& relief, const Plot& plot) {
  constexpr double kCell_px = 3.0;
  Raster<float> height_mm(static_cast<int>(plot.area.width / kCell_px) + 1,
                          static_cast<int>(plot.area.height / kCell_px) + 1);
  for (int y = 0; y < height_mm.height(); ++y) {
    for (int x = 0; x < height_mm.width(); ++x) {
      const double x_mm = plot.left + (plot.right - plot.left) * x / (height_mm.width() - 1);
      const double y_mm = plot.top - (plot.top - plot.bottom) * y / (height_mm.height() - 1);
      height_mm(x, y) = static_cast<float>(kMm * relief.sample(x_mm / kMm, y_mm / kMm).z_m);
    }
  }
  for (const double level : round_ticks(kMm * relief.lowest_m(), kMm * relief.highest_m(), 9))
    draw_height_lines(canvas, plot, height_mm, level, {{40, 40, 40}, 0.8, 0.45});
}

void draw_relief(Canvas& canvas, const models::Relief& relief, const Sheet& sheet, Rgb8 (*colour)(double)) {
  const Plot plot = plot_of(relief, sheet.plot);
  draw_axes(canvas, plot, "to the right, mm", "upwards, mm");
  draw_scale_bar(canvas, plot);
  draw_colour_bar(canvas, sheet.bar, kMm * relief.lowest_m(), kMm * relief.highest_m(),
                  "height above\nthe base, mm", colour);
}

}  // namespace

Figure relief_figure(models::Relief relief, const FigureTitle& title, Raster<Rgb8> picture) {
  const Sheet sheet = sheet_for(relief.size_x_m() / relief.size_y_m());
  return {
      sheet.width_px, sheet.height_px,
      [relief = std::move(relief), picture = std::move(picture), title, sheet](Canvas& canvas) {
        const Plot plot = plot_of(relief, sheet.plot);
        const double low = relief.lowest_m(), high = relief.highest_m();
        canvas.picture(rendered(relief, plot,
                                [&](const models::HeightSample& s, double u, double v) {
                                  const Rgb8 own = picture.empty() ? tint_colour(position(s.z_m, low, high))
                                                                   : colour_at(picture, u, v);
                                  return shaded(own, shade_of(s));
                                }),
                       sheet.plot);
        draw_all_height_lines(canvas, relief, plot);
        draw_relief(canvas, relief, sheet, tint_colour);
        draw_title_and_caption(
            canvas, sheet, title,
            fmt::format("Lit from the upper left, with slopes exaggerated twice. A height line every "
                        "{} mm of height.",
                        label_of(line_step_mm(kMm * low, kMm * high), line_step_mm(kMm * low, kMm * high))));
      }};
}

Figure height_figure(models::Relief relief, const FigureTitle& title) {
  const Sheet sheet = sheet_for(relief.size_x_m() / relief.size_y_m());
  return {sheet.width_px, sheet.height_px, [relief = std::move(relief), title, sheet](Canvas& canvas) {
            const double low = relief.lowest_m(), high = relief.highest_m();
            canvas.picture(rendered(relief, plot_of(relief, sheet.plot),
                                    [&](const models::HeightSample& s, double, double) {
                                      return depth_colour(position(s.z_m, low, high));
                                    }),
                           sheet.plot);
            draw_relief(canvas, relief, sheet, depth_colour);
            draw_title_and_caption(
                canvas, sheet, title,
                "Pale is high and near, dark is low and far. The colour scale is linear in the height.");
          }};
}

}  // namespace palpable::draw
