// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::draw {
namespace {

constexpr double kLargest_px = 860.0;
constexpr double kSheetLeft_px = 92.0;
constexpr double kSheetTop_px = 96.0;
constexpr double kSheetRight_px = 210.0;
constexpr double kSheetBelow_px = 108.0;

}  // namespace

Sheet sheet_for(double aspect) {
  const double ratio = std::clamp(aspect, 1.0 / 3.0, 3.0);
  const double width = std::round(ratio >= 1.0 ? kLargest_px : kLargest_px * ratio);
  const double height = std::round(ratio >= 1.0 ? kLargest_px / ratio : kLargest_px);
  Sheet sheet;
  sheet.plot = {kSheetLeft_px, kSheetTop_px, width, height};
  // Wide enough for the title even if the plot is narrow.
  sheet.width_px = static_cast<int>(std::max(kSheetLeft_px + width + kSheetRight_px, 640.0));
  sheet.height_px = static_cast<int>(kSheetTop_px + height + kSheetBelow_px);
  const double bar_height = std::min(320.0, height - 60.0);
  sheet.bar = {kSheetLeft_px + width + 36.0, kSheetTop_px + 54.0, 26.0, bar_height};
  sheet.caption = {kSheetLeft_px, kSheetTop_px + height + 60.0, sheet.width_px - kSheetLeft_px - 30.0, 40.0};
  return sheet;
}

void draw_title(Canvas& canvas, const FigureTitle& title, double left_px, double width_px) {
  canvas.text(title.title, {left_px, 22.0}, {.size_px = 23.0, .bold = true, .wrap_px = width_px});
  canvas.text(title.subtitle, {left_px, 58.0},
              {.size_px = 14.0, .colour = {80, 80, 80}, .wrap_px = width_px});
}

void draw_title_and_caption(Canvas& canvas, const Sheet& sheet, const FigureTitle& title,
                            const std::string& caption) {
  draw_title(canvas, title, sheet.plot.x, sheet.width_px - sheet.plot.x - 30.0);
  canvas.text(caption, {sheet.caption.x, sheet.caption.y},
              {.size_px = 13.0, .colour = {80, 80, 80}, .wrap_px = sheet.caption.width});
}

}  // namespace palpable::draw
