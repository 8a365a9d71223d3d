// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/map_view.hpp"

#include "palpable/draw/canvas/canvas.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace palpable::draw {
namespace {

constexpr Rgb8 kStreet{200, 30, 30};
constexpr Rgb8 kUnnamedStreet{235, 130, 20};
constexpr Rgb8 kJunctionMark{30, 60, 200};

Rgb8 colour_of(MapArea::Kind kind) {
  if (kind == MapArea::Kind::building) return {110, 80, 60};
  return kind == MapArea::Kind::water ? Rgb8{40, 110, 200} : Rgb8{60, 140, 60};
}

Raster<Rgb8> pale(Raster<Rgb8> picture) {
  const auto paler = [](std::uint8_t v) { return static_cast<std::uint8_t>(128 + v / 2); };
  for (Rgb8& c : picture.values()) c = {paler(c.r), paler(c.g), paler(c.b)};
  return picture;
}

}  // namespace

Figure map_figure(std::shared_ptr<const StreetMap> map, Raster<Rgb8> picture, double width_m,
                  const FigureTitle& title) {
  const Sheet sheet = sheet_for(static_cast<double>(map->width_px) / map->height_px);
  return {
      sheet.width_px, sheet.height_px,
      [map = std::move(map), picture = pale(std::move(picture)), width_m, title, sheet](Canvas& canvas) {
        if (!picture.empty()) canvas.picture(picture, sheet.plot);
        const double scale = sheet.plot.width / map->width_px;
        const auto on_sheet = [&](const std::vector<MapPoint>& points) {
          std::vector<CanvasPoint> out;
          for (const MapPoint p : points)
            out.push_back({sheet.plot.x + (p.x + 0.5) * scale, sheet.plot.y + (p.y + 0.5) * scale});
          return out;
        };
        for (const MapArea& area : map->areas) {
          constexpr double kTint = 0.3;
          canvas.polygon(on_sheet(area.outline), colour_of(area.kind), kTint);
        }
        for (const MapStreet& street : map->streets) {
          constexpr double kLine_px = 2.0;
          canvas.path(on_sheet(street.points), {street.name.empty() ? kUnnamedStreet : kStreet, kLine_px});
        }
        for (const MapJunction& junction : map->junctions) {
          constexpr double kRadius_px = 3.5;
          canvas.disc(on_sheet({junction.at}).front(), kRadius_px, kJunctionMark);
        }
        for (const MapLabel& label : map->labels) {
          auto box = on_sheet(label.box);
          if (box.empty()) continue;
          box.push_back(box.front());
          canvas.path(box, {label.names_street ? kStreet : kJunctionMark, 1.0});
          TextStyle style;
          style.size_px = 11.0;
          style.rim = true;
          style.colour = label.names_street ? kStreet : kJunctionMark;
          canvas.text(label.text, box.front(), style);
        }
        const double half_width = 0.5 * kMm * width_m;
        const double half_height = half_width * map->height_px / map->width_px;
        const Plot plot{sheet.plot, -half_width, half_width, -half_height, half_height};
        draw_axes(canvas, plot, "to the right, mm", "upwards, mm");
        draw_scale_bar(canvas, plot);
        draw_title_and_caption(canvas, sheet, title,
                               "Red: streets with a name; orange: streets without; blue dots: junctions; "
                               "tinted: buildings, water and green areas.");
      }};
}

}  // namespace palpable::draw
