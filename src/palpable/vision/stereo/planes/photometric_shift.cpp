// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/photometric_shift.hpp"

#include "palpable/core/vectorize.hpp"
#include "palpable/vision/stereo/planes/surface_window.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpable::vision {
namespace {

constexpr int kRounds = 2;
/// Where a shift is measured: pixels of one plane agree about it almost whatever their colour.
constexpr FitWindow kMeasured{.radius_px = 4, .step_px = 1, .like_colour = 30.0F};
constexpr FitWindow kCarried{.radius_px = 6, .step_px = 2};
constexpr float kMost_px = 0.5F;
/// The shift that is expected where nothing is measured: 0, with this deviation.
constexpr float kExpected_px = 0.3F;
/// Variance of luma that no shift explains: noise and rounding of both pictures.
constexpr float kNoise2 = 2.0F;
/// Neighbouring pixels err alike: so large a share of them counts as independent.
constexpr float kIndependent = 0.25F;
/// Differences of luma count half from here on.
constexpr float kHalfResidual = 10.0F;
constexpr float kLeastWeight = 1.0F;
constexpr float kLeastGradient2 = 1e-3F;
constexpr float kAgreement_px = 1.0F;

/// What the pictures say at each pixel of the map: by how much the left one is brighter than the right one
/// at the match, how fast the right one's luma changes there, and whether both see the same there, 0 or 1.
struct Evidence {
  Raster<float> residual, gradient, weight;
  Evidence(int w, int h) : residual(w, h), gradient(w, h), weight(w, h) {}
};

/// Whether the four pixels from `first` on all see a surface at this disparity. One of a nearer thing's among
/// them would mix its colour in.
bool all_see(const Raster<float>& other_disparity, int first, int y, float disparity) {
  for (int x = first; x < first + 4; ++x) {
    const float seen = other_disparity(std::clamp(x, 0, other_disparity.width() - 1), y);
    if (!(std::fabs(seen - disparity) <= kAgreement_px)) return false;
  }
  return true;
}

/// Compares the pictures along row y, the right one read by Catmull and Rom's cubic.
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
using Sums = RowSums<6>;

/// Adds the pixels at an offset: their residuals as they would be on the centre's plane.
PALPABLE_VECTORIZE
void add_to_sums(const SurfaceRow& centre, Offset offset, int count, const float* __restrict weight,
                 const float* __restrict rise, const float* __restrict residual,
                 const float* __restrict gradient, float* __restrict w, float* __restrict e1,
                 float* __restrict g1, float* __restrict eg, float* __restrict gg, float* __restrict ee) {
  constexpr float kPerResidual2 = 1.0F / (kHalfResidual * kHalfResidual);
  const auto dx = static_cast<float>(offset.x);
  const auto dy = static_cast<float>(offset.y);
  const float* __restrict sx = centre.slope_x;
  const float* __restrict sy = centre.slope_y;
  for (int x = 0; x < count; ++x) {
    const float g = gradient[x];
    const float e = residual[x] + g * (sx[x] * dx + sy[x] * dy - rise[x]);
    const float v = weight[x] / (1.0F + e * e * kPerResidual2);
    w[x] += v;
    e1[x] += v * e;
    g1[x] += v * g;
    eg[x] += v * e * g;
    gg[x] += v * g * g;
    ee[x] += v * e * e;
  }
}

/// Row y: moves the disparities by what the sums say and sets how much each counts from now on, 0…1.
void shift_row(const Sums& sums, int y, const Raster<float>& seen, PlaneMap& map, Raster<float>& trust) {
  constexpr float kPerExpected2 = 1.0F / (kExpected_px * kExpected_px);
  for (int x = 0; x < map.disparity.width(); ++x) {
    const auto i = static_cast<std::size_t>(x);
    const float total = sums.of[0][i];
    trust(x, y) = 0.0F;
    if (total < kLeastWeight) continue;
    const float e = sums.of[1][i] / total;
    const float g = sums.of[2][i] / total;
    const float eg = sums.of[3][i] / total - e * g;
    const float gg = sums.of[4][i] / total - g * g;
    const float ee = sums.of[5][i] / total - e * e;
    if (gg < kLeastGradient2) continue;
    const float unexplained = std::max(0.0F, ee - eg * eg / gg) + kNoise2;
    // The inverse of the shift's variance, and its share beside that of the expected shift.
    const float information = kIndependent * total * gg / unexplained;
    const float share = information / (information + kPerExpected2);
    map.disparity(x, y) += std::clamp(-share * eg / gg, -kMost_px, kMost_px);
    trust(x, y) = share * seen(x, y);
  }
}

void measure(const ColourPlanes& colour, const Evidence& evidence, PlaneMap& map, Raster<float>& trust,
             const Work& work) {
  const PlaneMap before = map;
  sum_over_surfaces<6>(
      colour, before, evidence.weight, kMeasured, work,
      [&](Place first, Offset offset, int count, const float* weights, const float* rises, Sums& sums) {
        const auto sum = [&](std::size_t k) { return sums.of[k].data() + first.x; };
        const auto there = [&](const Raster<float>& raster) {
          return raster.row(first.y + offset.y).data() + first.x + offset.x;
        };
        add_to_sums(surface_row(colour, before, evidence.weight, first.x, first.y), offset, count, weights,
                    rises, there(evidence.residual), there(evidence.gradient), sum(0), sum(1), sum(2), sum(3),
                    sum(4), sum(5));
      },
      [&](const Sums& sums, int y) { shift_row(sums, y, evidence.weight, map, trust); });
}

}  // namespace

void shift_between_pixels(const ColourPlanes& colour, const Raster<std::uint8_t>& luma,
                          const Raster<std::uint8_t>& other, const Raster<float>& other_disparity,
                          PlaneMap& map, const Work& work) {
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
  for (int round = 0; round < kRounds && !work.cancelled(); ++round) {
    evidence.weight = seen;
    parallel_for(work, h, 8, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) compare_row(luma, other, map.disparity, y, evidence);
    });
    measure(colour, evidence, map, trust, work);
    map = fit_planes(colour, map, trust, kCarried, work);
    for (std::size_t i = 0; i < before.count(); ++i) {
      const float b = before.values()[i];
      float& d = map.disparity.values()[i];
      d = std::clamp(d, b - kMost_px, b + kMost_px);
    }
  }
}

}  // namespace palpable::vision
