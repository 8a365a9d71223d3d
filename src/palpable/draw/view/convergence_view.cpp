// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/convergence_view.hpp"

#include "palpable/draw/canvas/canvas.hpp"
#include "palpable/draw/canvas/plot.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace palpable::draw {
namespace {

constexpr Rect kErrorPlot{84.0, 110.0, 640.0, 320.0};
constexpr double kLegend_px = 220.0;
constexpr std::array<Rgb8, 4> kPhaseColours{{{120, 70, 150}, {20, 100, 170}, {176, 58, 20}, {40, 120, 60}}};
constexpr Rgb8 kNotTaken{150, 150, 150};

Rgb8 colour_of(std::size_t phase) { return kPhaseColours[phase % kPhaseColours.size()]; }

// The first prediction may be so far off that nothing else could be read: the plot ends at three times the
// greatest error of the later phases, and what is above is written at its upper edge.
double top_of(const ConvergenceView& view) {
  double first = 0.0, later = 0.0;
  for (const auto& step : view.steps)
    (step.phase == 0 ? first : later) = std::max(step.phase == 0 ? first : later, step.error);
  constexpr double kMost = 3.0, kRoom = 1.1;
  const double top = later > 0.0 ? std::min(std::max(first, later), kMost * later) : first;
  return std::max(1e-6, kRoom * top);
}

void draw_steps(Canvas& canvas, const ConvergenceView& view, const Plot& plot) {
  std::vector<CanvasPoint> line;
  double error = 0.0;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const auto& step = view.steps[i];
    if (step.taken || i == 0) error = step.error;
    line.push_back(plot.at(static_cast<double>(i + 1), std::min(error, plot.top)));
  }
  if (line.size() > 1) canvas.path(line, {{90, 90, 90}, 1.5});
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const auto& step = view.steps[i];
    const CanvasPoint at = plot.at(static_cast<double>(i + 1), std::min(step.error, plot.top));
    canvas.disc(at, step.taken ? 4.0 : 3.0, step.taken ? colour_of(step.phase) : kNotTaken);
    if (step.error > plot.top)
      canvas.text(label_of(step.error, 0.1) + " mm", {at.x + 8.0, at.y + 2.0}, {.size_px = 13.0});
  }
}

void draw_legend(Canvas& canvas, const ConvergenceView& view) {
  double y = kErrorPlot.y;
  const double x = kErrorPlot.right() + 24.0;
  const auto entry = [&](Rgb8 colour, const std::string& name) {
    canvas.disc({x, y + 9.0}, 4.0, colour);
    y += 8.0 + canvas.text(name, {x + 12.0, y}, {.size_px = 14.0, .wrap_px = kLegend_px - 40.0});
  };
  for (std::size_t phase = 0; phase < view.phases.size(); ++phase)
    entry(colour_of(phase), view.phases[phase]);
  if (std::any_of(view.steps.begin(), view.steps.end(), [](const auto& step) { return !step.taken; }))
    entry(kNotTaken, "not taken: it would have raised the error");
}

}  // namespace

Figure convergence_figure(ConvergenceView view, const FigureTitle& title) {
  const int width = static_cast<int>(kErrorPlot.right() + kLegend_px),
            height = static_cast<int>(kErrorPlot.bottom() + 70.0);
  return {width, height, [view = std::move(view), title, width](Canvas& canvas) {
            draw_title(canvas, title, kErrorPlot.x, width - 2 * kErrorPlot.x);
            const Plot plot{kErrorPlot, 0.0, static_cast<double>(view.steps.size()) + 1.0, 0.0, top_of(view)};
            draw_axes(canvas, plot, "step", "distance of the points from the surface, mm");
            draw_steps(canvas, view, plot);
            draw_legend(canvas, view);
          }};
}

}  // namespace palpable::draw
