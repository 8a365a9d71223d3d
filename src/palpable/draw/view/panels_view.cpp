// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/panels_view.hpp"

#include "palpable/core/check.hpp"
#include "palpable/draw/canvas/canvas.hpp"
#include "palpable/draw/canvas/colour_map.hpp"
#include "palpable/draw/canvas/plot.hpp"
#include "palpable/draw/canvas/sheet.hpp"
#include "palpable/draw/canvas/value_range.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::draw {
namespace {

constexpr int kColumns = 3;
constexpr double kPanel_px = 380.0, kBetween_px = 18.0, kMargin_px = 28.0, kAbove_px = 92.0, kWords_px = 52.0,
                 kBar_px = 130.0;

void draw_map(Canvas& canvas, const Raster<float>& values, std::pair<float, float> range, Rect area) {
  Raster<Rgb8> pixels(values.width(), values.height());
  Raster<std::uint8_t> unknown(values.width(), values.height());
  for (std::size_t i = 0; i < values.count(); ++i) {
    const float v = values.values()[i];
    unknown.values()[i] = std::isfinite(v) ? 0 : 1;
    if (std::isfinite(v))
      pixels.values()[i] =
          depth_colour(static_cast<double>((v - range.first) / (range.second - range.first)));
  }
  canvas.picture(pixels, area);
  canvas.hatch(unknown, area);
}

void draw_panel(Canvas& canvas, const Panel& panel, std::pair<float, float> range, Rect area) {
  canvas.text(panel.name, {area.x, area.y}, {.size_px = 15.0, .bold = true, .wrap_px = area.width});
  const Rect picture{area.x, area.y + 22.0, area.width, area.height - kWords_px};
  if (const auto* map = std::get_if<Raster<float>>(&panel.content))
    draw_map(canvas, *map, range, picture);
  else
    canvas.picture(std::get<Raster<Rgb8>>(panel.content), picture);
  canvas.frame(picture, {{70, 70, 70}, 1.0});
  canvas.text(panel.caption, {area.x, picture.bottom() + 5.0},
              {.size_px = 12.5, .colour = {80, 80, 80}, .wrap_px = area.width});
}

double aspect_of(const Panel& panel) {
  return std::visit([](const auto& raster) { return static_cast<double>(raster.height()) / raster.width(); },
                    panel.content);
}

std::pair<float, float> range_of(const std::vector<Panel>& panels) {
  for (const Panel& panel : panels)
    if (const auto* map = std::get_if<Raster<float>>(&panel.content)) return display_range(*map);
  return {0.0F, 1.0F};
}

}  // namespace

Figure panels_figure(std::vector<Panel> panels, const FigureTitle& title) {
  PALPABLE_CHECK(!panels.empty());
  const auto count = static_cast<int>(panels.size());
  const int columns = std::min(kColumns, count), rows = (count + columns - 1) / columns;
  const double height = std::round(kPanel_px * std::clamp(aspect_of(panels.front()), 0.3, 2.0)) + kWords_px;
  const double width = 2.0 * kMargin_px + columns * kPanel_px + (columns - 1) * kBetween_px + kBar_px;
  return {static_cast<int>(width), static_cast<int>(kAbove_px + rows * (height + kBetween_px) + 16.0),
          [=, panels = std::move(panels)](Canvas& canvas) {
            draw_title(canvas, title, kMargin_px, width - 2.0 * kMargin_px);
            const auto range = range_of(panels);
            for (int i = 0; i < count; ++i)
              draw_panel(canvas, panels[static_cast<std::size_t>(i)], range,
                         {kMargin_px + (i % columns) * (kPanel_px + kBetween_px),
                          kAbove_px + (i / columns) * (height + kBetween_px), kPanel_px, height});
            draw_colour_bar(canvas,
                            {width - kBar_px + 8.0, kAbove_px + 62.0, 24.0, std::min(260.0, height - 90.0)},
                            static_cast<double>(range.first), static_cast<double>(range.second),
                            "disparity,\npixels", depth_colour);
          }};
}

}  // namespace palpable::draw
