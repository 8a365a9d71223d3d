// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plain_steps.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {
namespace {

/// The pixel beyond the edge whose disparity is compared: mixed and sharpened pixels lie between.
constexpr int kBeyondEdge_px = 3;

/// The colour difference of a pixel to the surface that has this end.
int differs(const ColourPlanes& colour, const SurfaceEnd& end, int x, int y) {
  return colour.difference(end.x + 2 * end.dx, end.y + 2 * end.dy, x, y);
}

/// The number of pixels from the edge at `end` to a step in the plain surface; 0 if there is none.
int pixels_before_step(const ColourPlanes& colour, const Raster<float>& disparity_px, const SurfaceEnd& end,
                       const PlainStepOptions& options) {
  const auto at = [&](int i) { return disparity_px(end.x + i * end.dx, end.y + i * end.dy); };
  for (int i = 1; i <= options.reach_px; ++i) {
    const int x = end.x + (i + 1) * end.dx, y = end.y + (i + 1) * end.dy;
    if (!disparity_px.contains(x, y)) return 0;
    if (differs(colour, end, x, y) > options.edges.plain_levels) return 0;
    if (at(i + 1) < at(i - 1) - options.least_step_px) return i;
  }
  return 0;
}

/// Continues the farther part of a plain surface to its end.
void continue_to(const SurfaceEnd& end, const ColourPlanes& colour, const Raster<float>& before,
                 const PlainStepOptions& options, Raster<float>& out) {
  const float beyond = before(end.x - kBeyondEdge_px * end.dx, end.y - kBeyondEdge_px * end.dy);
  if (std::fabs(beyond - before(end.x, end.y)) > options.same_px) return;
  const int count = pixels_before_step(colour, before, end, options);
  const float farther = before(end.x + (count + 1) * end.dx, end.y + (count + 1) * end.dy);
  for (int i = 0; i <= count && count > 0; ++i) {
    const int x = end.x + i * end.dx, y = end.y + i * end.dy;
    if (differs(colour, end, x, y) <= options.edges.plain_levels) out(x, y) = std::min(out(x, y), farther);
  }
}

}  // namespace

std::vector<Parameter> parameters_of(PlainStepOptions& o) {
  std::vector<Parameter> all{
      {"reach_px", &o.reach_px, {0, 60}, "px", "Pixels of a plain surface in which a step is looked for"},
      {"least_step_px", &o.least_step_px, {0.1, 100}, "px", "A step falls by more over two pixels"},
      {"same_px", &o.same_px, {0, 10}, "px", "The band belongs to the surface beyond the edge"}};
  append_parameters(all, "edges", parameters_of(o.edges));
  return all;
}

void move_steps_in_plain_surfaces(const ColourPlanes& colour, const PlainStepOptions& options,
                                  Raster<float>& disparity_px, const Work& work) {
  if (options.reach_px == 0) return;
  const auto pass = [&](int dx, int dy) {
    const Raster<float> before = disparity_px;
    const auto end_at = [&](const SurfaceEnd& end) {
      if (is_plain_up_to_edge(colour, end, options.edges))
        continue_to(end, colour, before, options, disparity_px);
    };
    const int lines = dx != 0 ? colour.height() : colour.width();
    const int length = dx != 0 ? colour.width() : colour.height();
    parallel_for(work, lines, 8, [&](int begin, int stop) {
      for (int line = begin; line < stop; ++line)
        for (int i = 0; i + 2 < length; ++i) {
          const int x = dx != 0 ? i : line, y = dx != 0 ? line : i;
          if (colour.difference(x, y, x + 2 * dx, y + 2 * dy) <= options.edges.edge_levels) continue;
          end_at({x, y, -dx, -dy});
          end_at({x + 2 * dx, y + 2 * dy, dx, dy});
        }
    });
  };
  pass(1, 0);
  pass(0, 1);
}

}  // namespace palpable::vision
