// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/gaussian_derivatives.hpp"

#include "palpable/core/vectorize.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {
namespace {

int reach(double sigma_px) { return static_cast<int>(std::ceil(4.5 * sigma_px)); }

/// out[i] = sum_k taps[k] (a[i+k] + sign a[i-k]), tap 0 once. `a` is readable from -reach to n+reach.
PALPABLE_VECTORIZE
void along_row(const float* a, float* out, int n, const float* taps, int reach_px, float sign) {
  const float centre = sign > 0.0F ? taps[0] : 0.0F;
  for (int i = 0; i < n; ++i) out[i] = centre * a[i];
  for (int k = 1; k <= reach_px; ++k) {
    const float w = taps[k];
    for (int i = 0; i < n; ++i) out[i] += w * (a[i + k] + sign * a[i - k]);
  }
}

/// out += w (a + sign b), over n values.
PALPABLE_VECTORIZE
void add_rows(const float* a, const float* b, float* out, int n, float w, float sign) {
  for (int i = 0; i < n; ++i) out[i] += w * (a[i] + sign * b[i]);
}

/// The image's row y smoothed or differentiated down the columns, with `reach_px` level values on both sides.
void down_columns(const Raster<float>& image, int y, const std::vector<float>& taps, float sign,
                  std::vector<float>& padded) {
  const int n = image.width();
  const int r = static_cast<int>(taps.size()) - 1;
  const auto row = [&](int j) { return image.row(std::clamp(j, 0, image.height() - 1)).data(); };
  float* out = padded.data() + r;
  std::fill(padded.begin(), padded.end(), 0.0F);
  if (sign > 0.0F) add_rows(row(y), row(y), out, n, 0.5F * taps[0], 1.0F);
  for (int k = 1; k <= r; ++k)
    add_rows(row(y + k), row(y - k), out, n, taps[static_cast<std::size_t>(k)], sign);
  std::fill(padded.begin(), padded.begin() + r, out[0]);
  std::fill(padded.begin() + r + n, padded.end(), out[n - 1]);
}

}  // namespace

std::vector<float> half_gaussian(double sigma_px) {
  const int r = reach(sigma_px);
  std::vector<double> g(static_cast<std::size_t>(r) + 1);
  double sum = 0.0;
  for (int k = 0; k <= r; ++k) {
    g[static_cast<std::size_t>(k)] = std::exp(-0.5 * k * k / (sigma_px * sigma_px));
    sum += (k == 0 ? 1.0 : 2.0) * g[static_cast<std::size_t>(k)];
  }
  std::vector<float> taps;
  for (const double v : g) taps.push_back(static_cast<float>(v / sum));
  return taps;
}

std::vector<float> half_gaussian_derivative(double sigma_px) {
  const int r = reach(sigma_px);
  std::vector<double> d(static_cast<std::size_t>(r) + 1);
  double ramp = 0.0;
  for (int k = 0; k <= r; ++k) {
    d[static_cast<std::size_t>(k)] = k * std::exp(-0.5 * k * k / (sigma_px * sigma_px));
    ramp += 2.0 * k * d[static_cast<std::size_t>(k)];
  }
  std::vector<float> taps;
  for (const double v : d) taps.push_back(static_cast<float>(v / ramp));
  return taps;
}

Gradient gaussian_gradient(const Raster<float>& image, double sigma_px, const Work& work) {
  const auto smooth = half_gaussian(sigma_px);
  const auto derive = half_gaussian_derivative(sigma_px);
  const int r = reach(sigma_px);
  const int n = image.width();
  Gradient out{Raster<float>(n, image.height()), Raster<float>(n, image.height())};
  parallel_for(work, image.height(), 16, [&](int begin, int end) {
    std::vector<float> padded(static_cast<std::size_t>(n + 2 * r));
    for (int y = begin; y < end; ++y) {
      down_columns(image, y, smooth, 1.0F, padded);
      along_row(padded.data() + r, out.x.row(y).data(), n, derive.data(), r, -1.0F);
      down_columns(image, y, derive, -1.0F, padded);
      along_row(padded.data() + r, out.y.row(y).data(), n, smooth.data(), r, 1.0F);
    }
  });
  return out;
}

Raster<float> gaussian_blur(const Raster<float>& image, double sigma_px, const Work& work) {
  const auto smooth = half_gaussian(sigma_px);
  const int r = reach(sigma_px);
  Raster<float> out(image.width(), image.height());
  parallel_for(work, image.height(), 16, [&](int begin, int end) {
    std::vector<float> padded(static_cast<std::size_t>(image.width() + 2 * r));
    for (int y = begin; y < end; ++y) {
      down_columns(image, y, smooth, 1.0F, padded);
      along_row(padded.data() + r, out.row(y).data(), image.width(), smooth.data(), r, 1.0F);
    }
  });
  return out;
}

}  // namespace palpable::vision
