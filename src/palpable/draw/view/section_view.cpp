// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/section_view.hpp"

#include "palpable/draw/canvas/colour_map.hpp"
#include "palpable/draw/canvas/plot.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace palpable::draw {
namespace {

constexpr double kSection_px = 900.0;
constexpr double kBeside_px = 92.0;
constexpr double kProfileTop_px = 110.0;
constexpr double kMap_px = 190.0;
constexpr Rgb8 kCut{200, 40, 40};
constexpr Rgb8 kSolid{196, 178, 150};

/// The vertical exaggeration: the smallest round factor that makes the profile at least a quarter as high as
/// it is wide.
double stretch_of(double width_mm, double height_mm) {
  constexpr double kWanted = 0.25;
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0})
    if (factor * height_mm >= kWanted * width_mm) return factor;
  return 50.0;
}

Raster<Rgb8> small_map(const models::Relief& relief, int width, int height) {
  Raster<Rgb8> map(width, height);
  const double span = std::max(relief.highest_m() - relief.lowest_m(), 1e-9);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double x_m = ((x + 0.5) / width - 0.5) * relief.size_x_m(),
                   y_m = (0.5 - (y + 0.5) / height) * relief.size_y_m();
      map(x, y) = depth_colour((relief.sample(x_m, y_m).z_m - relief.lowest_m()) / span);
    }
  }
  return map;
}

void draw_profile(Canvas& canvas, const models::Relief& relief, double y_m, const Plot& plot) {
  const int count = static_cast<int>(plot.area.width) * 2;
  std::vector<CanvasPoint> surface;
  for (int i = 0; i <= count; ++i) {
    const double x_mm = plot.left + (plot.right - plot.left) * i / count;
    surface.push_back(plot.at(x_mm, kMm * relief.sample(x_mm / kMm, y_m).z_m));
  }
  std::vector<CanvasPoint> solid = surface;
  solid.push_back({plot.area.right(), plot.area.bottom()});
  solid.push_back({plot.area.x, plot.area.bottom()});
  for (const double z :
       round_ticks(plot.bottom, plot.top, std::max(4, static_cast<int>(plot.area.height / 50.0))))
    canvas.line({plot.area.x, plot.y(z)}, {plot.area.right(), plot.y(z)}, {{215, 215, 215}, 1.0});
  canvas.polygon(solid, kSolid);
  canvas.path(surface, {{60, 45, 25}, 2.0});
  draw_axes(canvas, plot, "to the right, mm", "height, mm");
}

}  // namespace

Figure section_figure(models::Relief relief, double y_m, const FigureTitle& title) {
  const double width_mm = kMm * relief.size_x_m();
  const double high_mm = std::max(kMm * relief.highest_m() * 1.08, 0.1),
               low_mm = std::min(0.0, kMm * relief.lowest_m());
  const double stretch = stretch_of(width_mm, high_mm - low_mm);
  const double height_px = std::clamp(kSection_px / width_mm * stretch * (high_mm - low_mm), 60.0, 700.0);
  const Plot plot{
      {kBeside_px, kProfileTop_px, kSection_px, height_px}, -0.5 * width_mm, 0.5 * width_mm, low_mm, high_mm};
  const double map_height = std::clamp(kMap_px * relief.size_y_m() / relief.size_x_m(), 60.0, 380.0);
  const Rect map{kBeside_px, plot.area.bottom() + 84.0, kMap_px, map_height};
  const int page_width = static_cast<int>(kBeside_px + kSection_px + 50.0),
            page_height = static_cast<int>(map.bottom() + 30.0);
  return {page_width, page_height, [=, relief = std::move(relief)](Canvas& canvas) {
            draw_title(canvas, title, kBeside_px, kSection_px);
            draw_profile(canvas, relief, y_m, plot);
            canvas.picture(
                small_map(relief, static_cast<int>(map.width) * 2, static_cast<int>(map.height) * 2), map);
            canvas.frame(map, {{70, 70, 70}, 1.2});
            const double cut_y = map.y + (0.5 - y_m / relief.size_y_m()) * map.height;
            canvas.line({map.x - 8.0, cut_y}, {map.right() + 8.0, cut_y}, {{255, 255, 255}, 4.0});
            canvas.line({map.x - 8.0, cut_y}, {map.right() + 8.0, cut_y}, {kCut, 2.0});
            const std::string stretched =
                stretch > 1.0 ? fmt::format("heights are drawn {:g} times larger than widths", stretch)
                              : std::string("heights and widths are drawn at the same scale");
            canvas.text(
                fmt::format("The red line shows where the relief is cut: {} mm {} its middle.\nAbove, {}. "
                            "Pale is high, dark is low.",
                            label_of(std::abs(kMm * y_m), 0.1), y_m >= 0.0 ? "above" : "below", stretched),
                {map.right() + 30.0, map.y}, {.size_px = 14.0, .wrap_px = kSection_px - kMap_px - 40.0});
          }};
}

}  // namespace palpable::draw
