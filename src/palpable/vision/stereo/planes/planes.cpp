// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/planes.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/stereo/planes/surface_window.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpable::vision {
namespace {

/// The weighted sums of the normal equations.
using PlaneSums = RowSums<9>;

/// The sums of the windows of row y.
PALPABLE_VECTORIZE
void sum_row(const SurfaceWindows& windows, int y, PlaneSums& out) {
  for (int x = 0; x < windows.width; x += kSurfaceLanes) {
    SurfaceCentres centres;
    load_centres(windows, x, y, centres);
    SurfaceLanes w = {}, x1 = {}, y1 = {}, xx = {}, xy = {}, yy = {}, z1 = {}, xz = {}, yz = {};
    over_window(
        windows, x, y, [&](const WindowOffset& o, std::size_t at) __attribute__((always_inline)) {
          SurfaceLanes v, rise;
          weigh(windows, centres, o, at, v, rise);
          const SurfaceLanes vx = v * o.dx, vy = v * o.dy, vz = v * rise;
          w += v;
          x1 += vx;
          y1 += vy;
          xx += vx * o.dx;
          xy += vx * o.dy;
          yy += vy * o.dy;
          z1 += vz;
          xz += vz * o.dx;
          yz += vz * o.dy;
        });
    out.store(x, {w, x1, y1, xx, xy, yy, z1, xz, yz});
  }
}

void solve(const PlaneSums& sums, const PlaneMap& map, const PlaneFitOptions& fit, int y, PlaneMap& out) {
  for (int x = 0; x < map.disparity.width(); ++x) {
    const auto i = static_cast<std::size_t>(x);
    const float weight = sums.of[0][i];
    out.disparity(x, y) = map.disparity(x, y);
    out.slope_x(x, y) = map.slope_x(x, y);
    out.slope_y(x, y) = map.slope_y(x, y);
    if (weight <= fit.least_weight) continue;
    const float mx = sums.of[1][i] / weight;
    const float my = sums.of[2][i] / weight;
    const float mz = sums.of[6][i] / weight;
    const float xx = sums.of[3][i] / weight - mx * mx + fit.ridge_px2;
    const float xy = sums.of[4][i] / weight - mx * my;
    const float yy = sums.of[5][i] / weight - my * my + fit.ridge_px2;
    const float xz = sums.of[7][i] / weight - mx * mz;
    const float yz = sums.of[8][i] / weight - my * mz;
    const float determinant = xx * yy - xy * xy;
    if (!(determinant > 0.0F)) continue;
    const float sx = std::clamp((yy * xz - xy * yz) / determinant, -fit.steepest, fit.steepest_rise);
    const float sy = std::clamp((xx * yz - xy * xz) / determinant, -fit.steepest, fit.steepest);
    out.slope_x(x, y) = sx;
    out.slope_y(x, y) = sy;
    out.disparity(x, y) += mz - sx * mx - sy * my;
  }
}

}  // namespace

std::vector<Parameter> parameters_of(FitWindow& w) {
  return {
      {"radius_px", &w.radius_px, {1, 60}, "px", "Reach of the window to each side"},
      {"step_px", &w.step_px, {1, 16}, "px", "Every n-th row and column of the window is used"},
      {"half_weight_levels",
       &w.half_weight_levels,
       {1, 255},
       "levels",
       "Colour difference at which a weight is half"},
      {"tolerance_px", &w.tolerance_px, {0.05, 10}, "px", "Distance from the plane at which a weight is 0"},
      {"tolerance_per_px",
       &w.tolerance_per_px,
       {0, 1},
       "px",
       "How much it grows with each pixel of distance"}};
}

std::vector<Parameter> parameters_of(PlaneFitOptions& o) {
  return {
      {"least_weight", &o.least_weight, {0, 100}, "", "Sum of weights below which a plane is not refitted"},
      {"ridge_px2", &o.ridge_px2, {0, 10}, "px²", "Added to the variances of the window's coordinates"},
      {"steepest", &o.steepest, {0, 4}, "px/px", "Steepest slope of disparity"},
      {"steepest_rise", &o.steepest_rise, {0, 0.99}, "px/px", "Steepest rise of disparity to the right"}};
}

PlaneMap planes_in_other_view(const PlaneMap& map, const PlaneFitOptions& fit, const Work& work) {
  const int w = map.disparity.width();
  PlaneMap out(w, map.disparity.height());
  std::fill(out.disparity.values().begin(), out.disparity.values().end(), NAN);
  parallel_for(work, map.disparity.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < w; ++x) {
        const float d = map.disparity(x, y);
        const float place = static_cast<float>(w - 1 - x) + d;
        const int there = static_cast<int>(std::floor(place + 0.5F));
        if (there < 0 || there >= w || out.disparity(there, y) > d) continue;
        // d as a function of the other view's position: slope d' / (1 - d'), mirrored along a row.
        const float stretch = 1.0F / (1.0F - std::min(map.slope_x(x, y), fit.steepest_rise));
        const float sx = std::clamp(-map.slope_x(x, y) * stretch, -fit.steepest, fit.steepest_rise);
        out.slope_x(there, y) = sx;
        out.slope_y(there, y) = std::clamp(map.slope_y(x, y) * stretch, -fit.steepest, fit.steepest);
        out.disparity(there, y) = d + sx * (static_cast<float>(there) - place);
      }
  });
  return out;
}

PlaneMap fit_planes(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight,
                    const FitWindow& window, const PlaneFitOptions& fit, const Work& work) {
  PlaneMap out(colour.width(), colour.height());
  const SurfaceWindows windows(colour, map, weight, window, work);
  parallel_for(work, out.disparity.height(), 8, [&](int begin, int end) {
    PlaneSums sums(windows.width);
    for (int y = begin; y < end; ++y) {
      sum_row(windows, y, sums);
      solve(sums, map, fit, y, out);
    }
  });
  return out;
}

}  // namespace palpable::vision
