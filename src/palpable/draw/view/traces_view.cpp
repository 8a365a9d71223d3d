// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/traces_view.hpp"

#include "palpable/draw/canvas/plot.hpp"
#include "palpable/draw/canvas/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::draw {
namespace {

constexpr double kTraceLeft_px = 70, kTraceTop_px = 130, kTrace_px = 250, kTraceHeight_px = 130,
                 kTraceGap_px = 74;
constexpr double kMs = 1000.0;
constexpr double kLeast = 0.05;

void draw_trace(Canvas& canvas, const Trace& trace, const Plot& plot, const std::string& value_name) {
  std::vector<CanvasPoint> path;
  for (std::size_t i = 0; i < trace.values.size(); ++i)
    path.push_back(plot.at(kMs * trace.period_s * static_cast<double>(i), trace.values[i]));
  canvas.line({plot.area.x, plot.y(0.0)}, {plot.area.right(), plot.y(0.0)}, {{215, 215, 215}, 1.0});
  canvas.path(path, {{160, 40, 30}, 1.6});
  draw_axes(canvas, plot, "ms", value_name);
  canvas.text(trace.title, {plot.area.x, plot.area.y - 20.0}, {.size_px = 13.0, .bold = true});
}

}  // namespace

Figure traces_figure(std::vector<Trace> traces, int columns, const std::string& value_name,
                     const FigureTitle& title) {
  const int rows = (static_cast<int>(traces.size()) + columns - 1) / columns;
  double most = kLeast;
  for (const Trace& trace : traces)
    for (const double value : trace.values) most = std::max(most, 1.1 * std::abs(value));
  const double width_px = columns * (kTrace_px + kTraceGap_px);
  return {static_cast<int>(kTraceLeft_px + width_px),
          static_cast<int>(kTraceTop_px + rows * (kTraceHeight_px + kTraceGap_px)),
          [=, traces = std::move(traces)](Canvas& canvas) {
            draw_title(canvas, title, kTraceLeft_px, width_px - kTraceGap_px);
            for (std::size_t k = 0; k < traces.size(); ++k) {
              const int row = static_cast<int>(k) / columns, column = static_cast<int>(k) % columns;
              const Trace& trace = traces[k];
              const Plot plot{
                  {kTraceLeft_px + column * (kTrace_px + kTraceGap_px),
                   kTraceTop_px + row * (kTraceHeight_px + kTraceGap_px), kTrace_px, kTraceHeight_px},
                  0.0,
                  kMs * trace.period_s * static_cast<double>(trace.values.size()),
                  -most,
                  most};
              draw_trace(canvas, trace, plot, column == 0 ? value_name : "");
            }
          }};
}

}  // namespace palpable::draw
