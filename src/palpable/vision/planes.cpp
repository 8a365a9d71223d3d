// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/planes.hpp"

#include "palpable/core/vectorize.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace palpable::vision {
namespace {

constexpr float kLikeColour = 12.0F;
/// How far a disparity may lie from the plane: at the centre, and more for each pixel of distance.
constexpr float kTolerance_px = 1.0F;
constexpr float kTolerancePerPixel_px = 0.04F;
constexpr float kLeastWeight = 3.0F;
/// Added to the variances, in square pixels: a slope needs a base to stand on.
constexpr float kRidge_px2 = 0.05F;
constexpr float kSteepest = 1.5F;
/// A surface that falls off faster to the right is hidden from the other camera.
constexpr float kSteepestRise = 0.9F;

/// One row of the weighted sums of the normal equations, one value a pixel.
struct Sums {
  std::array<std::vector<float>, 9> of;
  explicit Sums(int width) {
    for (auto& s : of) s.resize(static_cast<std::size_t>(width));
  }
  void clear() {
    for (auto& s : of) std::fill(s.begin(), s.end(), 0.0F);
  }
};

struct Offset {
  int x, y;
};

/// What the sums of a row need of one row of the map.
struct RowView {
  const float* disparity;
  const float* slope_x;
  const float* slope_y;
  const float* weight;
  const std::uint8_t* r;
  const std::uint8_t* g;
  const std::uint8_t* b;
};

PALPABLE_VECTORIZE
void add_weights(const RowView& centre, const RowView& other, Offset offset, int count,
                 float* __restrict weight, float* __restrict rise) {
  const auto dx = static_cast<float>(offset.x);
  const auto dy = static_cast<float>(offset.y);
  const float per_tolerance =
      1.0F / (kTolerance_px + kTolerancePerPixel_px * (std::fabs(dx) + std::fabs(dy)));
  constexpr float kPerColour2 = 1.0F / (kLikeColour * kLikeColour);
  const float* __restrict d0 = centre.disparity;
  const float* __restrict d1 = other.disparity;
  const float* __restrict sx = centre.slope_x;
  const float* __restrict sy = centre.slope_y;
  const float* __restrict w1 = other.weight;
  const std::uint8_t* __restrict r0 = centre.r;
  const std::uint8_t* __restrict g0 = centre.g;
  const std::uint8_t* __restrict b0 = centre.b;
  const std::uint8_t* __restrict r1 = other.r;
  const std::uint8_t* __restrict g1 = other.g;
  const std::uint8_t* __restrict b1 = other.b;
  for (int x = 0; x < count; ++x) {
    const float z = d1[x] - d0[x];
    const float departure = std::fabs(z - (sx[x] * dx + sy[x] * dy)) * per_tolerance;
    const int dr = std::abs(r0[x] - r1[x]);
    const int dg = std::abs(g0[x] - g1[x]);
    const int db = std::abs(b0[x] - b1[x]);
    int c = dr > dg ? dr : dg;
    c = c > db ? c : db;
    const float q = static_cast<float>(c * c) * kPerColour2;
    const float near = 1.0F - departure;
    weight[x] = (near > 0.0F ? near : 0.0F) * w1[x] / (1.0F + q * q);
    rise[x] = z;
  }
}

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

void solve(const Sums& sums, const PlaneMap& map, int y, PlaneMap& out) {
  for (int x = 0; x < map.disparity.width(); ++x) {
    const auto i = static_cast<std::size_t>(x);
    const float weight = sums.of[0][i];
    out.disparity(x, y) = map.disparity(x, y);
    out.slope_x(x, y) = map.slope_x(x, y);
    out.slope_y(x, y) = map.slope_y(x, y);
    if (weight <= kLeastWeight) continue;
    const float mx = sums.of[1][i] / weight;
    const float my = sums.of[2][i] / weight;
    const float mz = sums.of[6][i] / weight;
    const float xx = sums.of[3][i] / weight - mx * mx + kRidge_px2;
    const float xy = sums.of[4][i] / weight - mx * my;
    const float yy = sums.of[5][i] / weight - my * my + kRidge_px2;
    const float xz = sums.of[7][i] / weight - mx * mz;
    const float yz = sums.of[8][i] / weight - my * mz;
    const float determinant = xx * yy - xy * xy;
    if (!(determinant > 0.0F)) continue;
    const float sx = std::clamp((yy * xz - xy * yz) / determinant, -kSteepest, kSteepestRise);
    const float sy = std::clamp((xx * yz - xy * xz) / determinant, -kSteepest, kSteepest);
    out.slope_x(x, y) = sx;
    out.slope_y(x, y) = sy;
    out.disparity(x, y) += mz - sx * mx - sy * my;
  }
}

}  // namespace

PlaneMap fit_planes(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight,
                    FitWindow window, const Work& work) {
  const int w = colour.width();
  const int h = colour.height();
  PlaneMap out(w, h);
  const auto view = [&](int x, int y) {
    const auto at = [&](const auto& raster) { return raster.row(y).data() + x; };
    return RowView{at(map.disparity), at(map.slope_x), at(map.slope_y), at(weight),
                   at(colour.r),      at(colour.g),    at(colour.b)};
  };
  parallel_for(work, h, 8, [&](int begin, int end) {
    Sums sums(w);
    std::vector<float> weights(static_cast<std::size_t>(w));
    std::vector<float> rises(static_cast<std::size_t>(w));
    for (int y = begin; y < end; ++y) {
      sums.clear();
      for (int dy = -window.radius_px; dy <= window.radius_px; dy += window.step_px) {
        if (y + dy < 0 || y + dy >= h) continue;
        for (int dx = -window.radius_px; dx <= window.radius_px; dx += window.step_px) {
          const int first = std::max(0, -dx);
          const int count = std::min(w, w - dx) - first;
          if (count <= 0) continue;
          add_weights(view(first, y), view(first + dx, y + dy), {dx, dy}, count, weights.data(),
                      rises.data());
          const auto sum = [&](std::size_t k) { return sums.of[k].data() + first; };
          add_to_sums(weights.data(), rises.data(), {dx, dy}, count, sum(0), sum(1), sum(2), sum(3), sum(4),
                      sum(5), sum(6), sum(7), sum(8));
        }
      }
      solve(sums, map, y, out);
    }
  });
  return out;
}

}  // namespace palpable::vision
