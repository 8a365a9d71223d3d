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

PALPABLE_VECTORIZE
void add_to_sums(const float* __restrict weight, const float* __restrict rise, Offset offset, int count,
                 float* __restrict w, float* __restrict x1, float* __restrict y1, float* __restrict xx,
                 float* __restrict xy, float* __restrict yy, float* __restrict z1, float* __restrict xz,
                 float* __restrict yz) {
  const auto dx = static_cast<float>(offset.x);
  const auto dy = static_cast<float>(offset.y);
  for (int x = 0; x < count; ++x) {
    const float v = weight[x];
    const float vx = v * dx;
    const float vy = v * dy;
    const float vz = v * rise[x];
    w[x] += v;
    x1[x] += vx;
    y1[x] += vy;
    xx[x] += vx * dx;
    xy[x] += vx * dy;
    yy[x] += vy * dy;
    z1[x] += vz;
    xz[x] += vz * dx;
    yz[x] += vz * dy;
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
  sum_over_surfaces<9>(
      colour, map, weight, window, work,
      [](Pixel first, Offset offset, int count, const float* weights, const float* rises, PlaneSums& sums) {
        const auto sum = [&](std::size_t k) { return sums.of[k].data() + first.x; };
        add_to_sums(weights, rises, offset, count, sum(0), sum(1), sum(2), sum(3), sum(4), sum(5), sum(6),
                    sum(7), sum(8));
      },
      [&](const PlaneSums& sums, int y) { solve(sums, map, fit, y, out); });
  return out;
}

}  // namespace palpable::vision
