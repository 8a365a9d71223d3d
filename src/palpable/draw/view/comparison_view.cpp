// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/comparison_view.hpp"

#include "palpable/draw/canvas/canvas.hpp"
#include "palpable/draw/canvas/relief_shading.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::draw {
namespace {

constexpr int kColumns = 3;
constexpr double kPanel_px = 380.0;
constexpr double kMargin_px = 28.0;
constexpr double kTitle_px = 96.0;
constexpr double kName_px = 26.0;
constexpr double kLine_px = 18.0;

/// Positions of the panels.
struct Grid {
  double picture_height = 0.0;
  double panel_height = 0.0;
  int rows = 0;

  CanvasPoint corner(std::size_t i) const {
    const auto column = static_cast<double>(i % kColumns);
    const auto row = static_cast<double>(i / kColumns);
    return {kMargin_px + column * (kPanel_px + kMargin_px), kTitle_px + row * (panel_height + kMargin_px)};
  }
};

Grid grid_for(const std::vector<ComparedRelief>& reliefs) {
  const models::Relief& first = reliefs.front().relief;
  std::size_t lines = 0;
  for (const ComparedRelief& r : reliefs) lines = std::max(lines, r.lines.size());
  Grid grid;
  grid.picture_height =
      std::round(kPanel_px / std::clamp(first.size_x_m() / first.size_y_m(), 1.0 / 3.0, 3.0));
  grid.panel_height = kName_px + grid.picture_height + 8.0 + kLine_px * static_cast<double>(lines);
  grid.rows = static_cast<int>((reliefs.size() + kColumns - 1) / kColumns);
  return grid;
}

void draw_panel(Canvas& canvas, const ComparedRelief& compared, CanvasPoint corner, double picture_height) {
  const Rect picture{corner.x, corner.y + kName_px, kPanel_px, picture_height};
  canvas.text(compared.name, corner, {.size_px = 16.0, .bold = true});
  canvas.picture(
      shaded_relief(compared.relief, static_cast<int>(picture.width), static_cast<int>(picture.height)),
      picture);
  double y = picture.bottom() + 8.0;
  for (const std::string& line : compared.lines) {
    canvas.text(line, {corner.x, y}, {.size_px = 12.5, .colour = {60, 60, 60}});
    y += kLine_px;
  }
}

}  // namespace

Figure comparison_figure(std::vector<ComparedRelief> reliefs, const FigureTitle& title) {
  const Grid grid = grid_for(reliefs);
  const int width = static_cast<int>(kMargin_px + kColumns * (kPanel_px + kMargin_px));
  const int height = static_cast<int>(kTitle_px + grid.rows * (grid.panel_height + kMargin_px));
  return {width, height, [reliefs = std::move(reliefs), title, grid, width](Canvas& canvas) {
            draw_title(canvas, title, kMargin_px, width - 2.0 * kMargin_px);
            for (std::size_t i = 0; i < reliefs.size(); ++i)
              draw_panel(canvas, reliefs[i], grid.corner(i), grid.picture_height);
          }};
}

}  // namespace palpable::draw
