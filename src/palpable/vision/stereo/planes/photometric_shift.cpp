// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/photometric_shift.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"
#include "palpable/vision/stereo/planes/surface_window.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpable::vision {
namespace {

/// The measurement at each pixel: the luma difference (left minus right) at the match, the right picture's
/// luma gradient there, and whether both views agree, 0 or 1.
struct Evidence {
  Raster<float> residual, gradient, weight;
  Evidence(int w, int h) : residual(w, h), gradient(w, h), weight(w, h) {}
};

/// Whether the four pixels from `first` on, which the cubic reads, all have this disparity. A pixel of a
/// nearer surface would contaminate the value.
bool all_see(const Raster<float>& other_disparity, int first, int y, float disparity) {
  for (int x = first; x < first + 4; ++x) {
    const float seen = other_disparity(std::clamp(x, 0, other_disparity.width() - 1), y);
    if (!(std::fabs(seen - disparity) <= kLeftRightTolerance_px)) return false;
  }
  return true;
}

/// Compares the pictures along row y; the right one is interpolated by a Catmull-Rom cubic.
void compare_row(const Raster<std::uint8_t>& luma, const Raster<std::uint8_t>& other,
                 const Raster<float>& disparity, int y, Evidence& out) {
  const auto row = other.row(y);
  const int last = other.width() - 1;
  const auto value = [&](int x) {
    return static_cast<float>(row[static_cast<std::size_t>(std::clamp(x, 0, last))]);
  };
  for (int x = 0; x <= last; ++x) {
    const float there = static_cast<float>(x) - disparity(x, y);
    if (out.weight(x, y) == 0.0F || !(there >= 0.0F) || there > static_cast<float>(last)) {
      out.residual(x, y) = out.gradient(x, y) = out.weight(x, y) = 0.0F;
      continue;
    }
    const int i = static_cast<int>(there);
    const float t = there - static_cast<float>(i);
    const float b = value(i);
    const float c = value(i + 1);
    const float p = c - value(i - 1);
    const float q = 2.0F * value(i - 1) - 5.0F * b + 4.0F * c - value(i + 2);
    const float r = 3.0F * (b - c) + value(i + 2) - value(i - 1);
    out.residual(x, y) = static_cast<float>(luma(x, y)) - (b + 0.5F * t * (p + t * (q + t * r)));
    out.gradient(x, y) = 0.5F * (p + t * (2.0F * q + 3.0F * t * r));
  }
}

/// Weighted sums over a window of a residual e and a gradient g: 1, e, g, e g, g g and e e.
using ShiftSums = RowSums<6>;

/// The measurements with margins, like the windows'.
struct PaddedEvidence {
  PaddedPlane residual, gradient;
};

/// The sums of the windows of row y, with the residuals reduced to the centre's plane.
PALPABLE_VECTORIZE
void sum_row(const SurfaceWindows& windows, const PaddedEvidence& evidence, float per_residual2, int y,
             ShiftSums& out) {
  for (int x = 0; x < windows.width; x += kSurfaceLanes) {
    SurfaceCentres centres;
    load_centres(windows, x, y, centres);
    SurfaceLanes w = {}, e1 = {}, g1 = {}, eg = {}, gg = {}, ee = {};
    over_window(
        windows, x, y, [&](const WindowOffset& o, std::size_t at) __attribute__((always_inline)) {
          SurfaceLanes v, rise, e, g;
          weigh(windows, centres, o, at, v, rise);
          load(evidence.residual, at, e);
          load(evidence.gradient, at, g);
          e += g * (centres.slope_x * o.dx + centres.slope_y * o.dy - rise);
          v /= 1.0F + e * e * per_residual2;
          w += v;
          e1 += v * e;
          g1 += v * g;
          eg += v * e * g;
          gg += v * g * g;
          ee += v * e * e;
        });
    out.store(x, {w, e1, g1, eg, gg, ee});
  }
}

/// Row y: shifts the disparities by the least-squares solution and sets their new weights, 0…1.
void shift_row(const ShiftSums& sums, const PhotometricShiftOptions& options, int y,
               const Raster<float>& seen, PlaneMap& map, Raster<float>& trust) {
  const float per_expected2 = 1.0F / (options.expected_px * options.expected_px);
  for (int x = 0; x < map.disparity.width(); ++x) {
    const auto i = static_cast<std::size_t>(x);
    const float total = sums.of[0][i];
    trust(x, y) = 0.0F;
    if (!(total > 0.0F) || total < options.least_weight) continue;
    const float e = sums.of[1][i] / total;
    const float g = sums.of[2][i] / total;
    const float eg = sums.of[3][i] / total - e * g;
    const float gg = sums.of[4][i] / total - g * g;
    const float ee = sums.of[5][i] / total - e * e;
    if (!(gg > 0.0F) || gg < options.least_gradient_variance) continue;
    const float unexplained = std::max(0.0F, ee - eg * eg / gg) + options.noise_variance;
    // The inverse variance of the shift, and its share relative to the prior's.
    const float information = options.independent_share * total * gg / unexplained;
    const float share = information / (information + per_expected2);
    map.disparity(x, y) += std::clamp(-share * eg / gg, -options.largest_px, options.largest_px);
    trust(x, y) = share * seen(x, y);
  }
}

void measure(const ColourPlanes& colour, const Evidence& evidence, const PhotometricShiftOptions& options,
             PlaneMap& map, Raster<float>& trust, const Work& work) {
  const SurfaceWindows windows(colour, map, evidence.weight, options.shift_window, work);
  const int margin = options.shift_window.radius_px;
  const PaddedEvidence padded{{evidence.residual, margin, work}, {evidence.gradient, margin, work}};
  const float per_residual2 = 1.0F / (options.half_weight_residual * options.half_weight_residual);
  parallel_for(work, windows.height, 8, [&](int begin, int end) {
    ShiftSums sums(windows.width);
    for (int y = begin; y < end; ++y) {
      sum_row(windows, padded, per_residual2, y, sums);
      shift_row(sums, options, y, evidence.weight, map, trust);
    }
  });
}

}  // namespace

std::vector<Parameter> parameters_of(PhotometricShiftOptions& o) {
  std::vector<Parameter> all{
      {"rounds", &o.rounds, {0, 20}, "", "Rounds of measuring and fitting"},
      {"largest_px", &o.largest_px, {0, 2}, "px", "The largest shift"},
      {"expected_px", &o.expected_px, {0.01, 10}, "px", "Standard deviation of an unmeasured shift"},
      {"noise_variance", &o.noise_variance, {0.01, 1000}, "levels²", "Noise variance of luma"},
      {"independent_share", &o.independent_share, {0.001, 1}, "", "Share of pixels with independent errors"},
      {"half_weight_residual",
       &o.half_weight_residual,
       {1, 255},
       "levels",
       "Luma difference at which a weight is half"},
      {"least_weight", &o.least_weight, {0, 1000}, "", "Sum of weights below which nothing is measured"},
      {"least_gradient_variance",
       &o.least_gradient_variance,
       {0, 1000},
       "levels²/px²",
       "Variance of the gradient below which nothing is measured"}};
  append_parameters(all, "shift_window", parameters_of(o.shift_window));
  append_parameters(all, "fit_window", parameters_of(o.fit_window));
  append_parameters(all, "fit", parameters_of(o.fit));
  return all;
}

void refine_photometrically(const ColourPlanes& colour, const Raster<std::uint8_t>& luma,
                            const Raster<std::uint8_t>& other, const Raster<float>& other_disparity,
                            const PhotometricShiftOptions& options, PlaneMap& map, const Work& work) {
  const int w = luma.width();
  const int h = luma.height();
  const Raster<float> before = map.disparity;
  Raster<float> seen(w, h);
  parallel_for(work, h, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < w; ++x) {
        const float d = before(x, y);
        const int first = static_cast<int>(std::floor(static_cast<float>(x) - d)) - 1;
        seen(x, y) = all_see(other_disparity, first, y, d) ? 1.0F : 0.0F;
      }
  });
  Evidence evidence(w, h);
  Raster<float> trust(w, h);
  for (int round = 0; round < options.rounds && !work.cancelled(); ++round) {
    evidence.weight = seen;
    parallel_for(work, h, 8, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) compare_row(luma, other, map.disparity, y, evidence);
    });
    measure(colour, evidence, options, map, trust, work);
    map = fit_planes(colour, map, trust, options.fit_window, options.fit, work);
    for (std::size_t i = 0; i < before.count(); ++i) {
      const float b = before.values()[i];
      float& d = map.disparity.values()[i];
      d = std::clamp(d, b - options.largest_px, b + options.largest_px);
    }
  }
}

}  // namespace palpable::vision
