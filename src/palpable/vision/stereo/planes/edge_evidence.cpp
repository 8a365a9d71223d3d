// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/edge_evidence.hpp"

#include <cmath>

namespace palpable::vision {
namespace {

/// Columns between an edge and the pixel whose disparity is compared, or from which a surface is plain: mixed
/// and sharpened pixels lie between.
constexpr int kFromEdge_px = 2, kBeyondEdge_px = 3;

}  // namespace

bool is_plain_up_to_edge(const ColourPlanes& colour, const SurfaceEnd& end,
                         const EdgeEvidenceOptions& options) {
  const auto x = [&](int away) { return end.x + away * end.dx; };
  const auto y = [&](int away) { return end.y + away * end.dy; };
  const int last = kFromEdge_px + options.plain_px - 1, farthest = -(kFromEdge_px + options.beyond_px - 1);
  if (!colour.r.contains(x(last), y(last)) || !colour.r.contains(x(farthest), y(farthest))) return false;
  const auto differs = [&](int away) {
    return colour.difference(x(kFromEdge_px), y(kFromEdge_px), x(away), y(away));
  };
  for (int i = -kFromEdge_px; i >= farthest; --i)
    if (differs(i) <= options.edge_levels) return false;
  for (int i = kFromEdge_px; i <= last; ++i)
    if (differs(i) > options.plain_levels) return false;
  return true;
}

std::vector<Parameter> parameters_of(EdgeEvidenceOptions& o) {
  return {{"reach_px", &o.reach_px, {0, 20}, "px", "Columns of a plain surface beside a colour edge"},
          {"edge_levels", &o.edge_levels, {1, 255}, "levels", "Colour difference of an edge"},
          {"beyond_px", &o.beyond_px, {2, 60}, "px", "Columns beyond the edge that differ as much"},
          {"plain_px", &o.plain_px, {1, 60}, "px", "Columns of similar colour that make a surface plain"},
          {"plain_levels", &o.plain_levels, {0, 255}, "levels", "Their greatest colour difference"},
          {"farther_px",
           &o.farther_px,
           {0, 10},
           "px",
           "The surface beyond the edge is the farther one from this difference on"}};
}

Raster<float> nearer_beyond_edges(const ColourPlanes& colour, const Raster<float>& disparity_px,
                                  const EdgeEvidenceOptions& options, const Work& work) {
  Raster<float> out(colour.width(), colour.height(), NAN);
  if (options.reach_px == 0) return out;
  // x is the last column before the edge; `away` leads from the edge into the surface.
  const auto mark = [&](int x, int y, int away) {
    if (!is_plain_up_to_edge(colour, {x, y, away, 0}, options)) return;
    const float beyond = disparity_px(x - away * kBeyondEdge_px, y);
    if (beyond < disparity_px(x, y) - options.farther_px) return;
    for (int i = 0; i < options.reach_px; ++i)
      if (out.contains(x + away * i, y)) out(x + away * i, y) = std::fmax(out(x + away * i, y), beyond);
  };
  parallel_for(work, out.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x + 2 < out.width(); ++x) {
        if (colour.difference(x, y, x + 2, y) <= options.edge_levels) continue;
        mark(x, y, -1);
        mark(x + 2, y, 1);
      }
  });
  return out;
}

}  // namespace palpable::vision
