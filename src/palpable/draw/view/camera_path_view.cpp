// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/camera_path_view.hpp"

#include "palpable/draw/canvas/canvas.hpp"
#include "palpable/draw/canvas/plot.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::draw {
namespace {

constexpr double kPathPlot_px = 380.0, kPathLeft_px = 84.0, kPathTop_px = 110.0, kPathBetween_px = 100.0;
constexpr Rgb8 kModelColour{110, 120, 130}, kPathColour{176, 58, 20};

// The plot that shows all values in one scale on both axes.
Plot plot_of(const std::vector<CanvasPoint>& all, Rect area) {
  double left = all.front().x, right = left, bottom = all.front().y, top = bottom;
  for (const CanvasPoint& p : all) {
    left = std::min(left, p.x), right = std::max(right, p.x);
    bottom = std::min(bottom, p.y), top = std::max(top, p.y);
  }
  const double half = std::max({right - left, top - bottom, 1e-9}) * 0.54;
  const double x = (left + right) / 2, y = (bottom + top) / 2;
  return {area, x - half, x + half, y - half, y + half};
}

void draw_side(Canvas& canvas, const CameraPathView& view, Rect area, const std::string& name,
               const std::string& upwards, CanvasPoint (*place)(const Vec3&)) {
  std::vector<CanvasPoint> cameras, points;
  for (const Vec3& p : view.cameras) cameras.push_back(place(p));
  for (const Vec3& p : view.points) points.push_back(place(p));
  std::vector<CanvasPoint> all = cameras;
  all.insert(all.end(), points.begin(), points.end());
  if (all.empty()) return;
  const Plot plot = plot_of(all, area);
  canvas.text(name, {area.x, area.y - 24.0}, {.size_px = 15.0, .bold = true});
  for (const CanvasPoint& p : points) canvas.disc(plot.at(p.x, p.y), 0.8, kModelColour, 0.6);
  for (CanvasPoint& p : cameras) p = plot.at(p.x, p.y);
  canvas.path(cameras, {kPathColour, 2.0});
  for (const CanvasPoint& p : cameras) canvas.disc(p, 2.2, kPathColour);
  if (!cameras.empty())
    canvas.text("start", {cameras.front().x + 6.0, cameras.front().y - 18.0},
                {.size_px = 13.0, .colour = kPathColour, .rim = true});
  draw_axes(canvas, plot, "to the right, " + view.unit, upwards + ", " + view.unit);
}

}  // namespace

Figure camera_path_figure(CameraPathView view, const FigureTitle& title) {
  const int width = static_cast<int>(2 * (kPathPlot_px + kPathBetween_px) + 20.0),
            height = static_cast<int>(kPathTop_px + kPathPlot_px + 70.0);
  return {width, height, [view = std::move(view), title, width](Canvas& canvas) {
            draw_title(canvas, title, kPathLeft_px, width - 2 * kPathLeft_px);
            draw_side(canvas, view, {kPathLeft_px, kPathTop_px, kPathPlot_px, kPathPlot_px}, "From above",
                      "to the back", [](const Vec3& p) {
                        return CanvasPoint{p.x, p.y};
                      });
            draw_side(
                canvas, view,
                {kPathLeft_px + kPathPlot_px + kPathBetween_px, kPathTop_px, kPathPlot_px, kPathPlot_px},
                "From the front", "upwards", [](const Vec3& p) {
                  return CanvasPoint{p.x, p.z};
                });
          }};
}

}  // namespace palpable::draw
